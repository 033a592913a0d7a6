const int lamp = NUM_DIGITAL_PINS > 20 ? 3 : 8;

void setup() {
#if F_CPU == 16000000L
  delay(10);
#endif
  delay(F_CPU / 1000000L);
  analogWrite(9, 200);
  analogWrite(A0, 200);
  analogWrite(4, 128);
  analogWrite(9, 300);
  analogWrite(9, -1);
  analogWrite(9, 255);
}

void loop() {}
