volatile byte count;

void setup() {
  TCCR1A = 0;
  TCCR1B = (1 << WGM12) | (1 << CS11);
  OCR1A = 999;
  TIMSK1 = (1 << OCIE1A);
}

ISR(TIMER1_COMPA_vect) { count++; }

void loop() {
  OCR1A = count * 10;
}
