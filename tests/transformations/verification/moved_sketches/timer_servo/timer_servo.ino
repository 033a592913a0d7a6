// A servo at OC1A, driven by timer 1 itself: 50 Hz, 1 to 2 ms.
void setup() {
  pinMode(9, OUTPUT);
  TCCR1A = _BV(COM1A1) | _BV(WGM11);
  TCCR1B = _BV(WGM13) | _BV(WGM12) | _BV(CS11);
  ICR1 = 39999;
  OCR1A = 3000;
}

void loop() {
  OCR1A = 2000;
  delay(100);
  OCR1A = 4000;
  delay(100);
}
