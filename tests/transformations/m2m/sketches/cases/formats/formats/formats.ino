char text[40];
int balance;
unsigned int turns;
int16_t heading;
long way;
byte level;
void setup() {
  randomSeed(1);
  balance = analogRead(A0) - random(2000);
  turns = 50000;
  way = -70000;
}
void loop() {
  sprintf(text, "%u %x", balance, balance);
  snprintf(text, sizeof(text), "%d%%", turns);
  snprintf_P(text, sizeof(text), PSTR("%5d %02X"), turns, level);
  sprintf(text, "%ld %d %u", way, balance, turns);
  sprintf(text, "%d", way);
  sprintf(text, "%ld", balance);
  sprintf(text, "%5.1f", 2.5);
  sscanf(text, "%d", &heading);
  tone(8, heading);
}
