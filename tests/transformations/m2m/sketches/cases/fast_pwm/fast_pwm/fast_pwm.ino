// A dimmed lamp at OC2B by registers: fast PWM with 8 bits.
void setup() {
  DDRD |= _BV(3);
  TCCR2A = _BV(COM2B1) | _BV(WGM21) | _BV(WGM20);
  TCCR2B = _BV(CS22);
  OCR2B = 63;
}

void loop() {
  OCR2B = 63;
  delay(60);
  OCR2B = 191;
  delay(60);
}
