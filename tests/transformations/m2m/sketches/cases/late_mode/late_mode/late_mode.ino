void setup() {
  TCCR1A = _BV(COM1A1) | _BV(WGM11);
  TCCR1B = _BV(WGM13) | _BV(WGM12) | _BV(CS11);
  ICR1 = 39999;
  DDRB |= _BV(1);
}

void loop() {
  OCR1A = OCR1A + 1;
}
