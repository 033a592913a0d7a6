void setup() {}

void loop() {
  int16_t now = millis();
  static int16_t last;
  static uint16_t begun = micros(), slow;
  unsigned long right = millis();
  if ((int16_t)(now - last) > 1000) last = now;
  if (micros() - begun > 500) begun = micros();
  if (right > 5000) slow = right / 1000 % 60;
}
