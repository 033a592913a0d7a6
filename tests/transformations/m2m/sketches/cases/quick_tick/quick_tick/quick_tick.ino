volatile byte count;

void begin() {
  TCCR2A = _BV(WGM21);
  TCCR2B = _BV(CS22);
  OCR2A = 249;
  TIMSK2 = _BV(OCIE2A);
}

ISR(TIMER2_COMPA_vect) { count++; }

void setup() { begin(); }

void loop() {}
