void setup() {}

void loop() {
  int now = millis();
  static int last;
  static unsigned int begun = micros(), slow;
  unsigned long right = millis();
  if (now - last > 1000) last = now;
  if (micros() - begun > 500) begun = micros();
  if (right > 5000) slow = right / 1000 % 60;
}
