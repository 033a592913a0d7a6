void setup() { int unused; }

void loop() {
  long big = 1000 * 1000;
  int level = digitalRead(2);
  if (level = HIGH) delay(big);
}
