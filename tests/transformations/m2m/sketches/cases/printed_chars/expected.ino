String line;
char last = 0;
void show(int value) { Serial.println(value); }

void setup() { Serial.begin(9600); while (!Serial && millis() < 3000) {} }

void loop() {
  char plain = Serial.read();
  if (plain == '\n') line = "";
  else line += plain;
  Serial.print(plain);
  if (plain >= '0' && plain <= '9') last = plain;
  signed char asked = Serial.read();
  if (asked < 0) Serial.println((char)asked);
  else line = line + (char)asked;
  signed char number = Serial.peek();
  show(number);
}
