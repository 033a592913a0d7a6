// Prints with formats of every width.
char line[40];
unsigned long since = 70000UL;
int level = -12;
double volts = 3.14159;

void setup() {
  Serial.begin(115200);
}

void loop() {
  snprintf(line, sizeof(line), "%d %u %lu %x", level, 65535u, since, 0xBEEF);
  Serial.println(line);
  char number[10];
  dtostrf(volts, 6, 2, number);
  Serial.println(number);
  since += 1234;
  level += 5;
  delay(80);
}
