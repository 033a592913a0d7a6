int level;

void setup() {
  ADCSRA = _BV(ADEN) | 7;
}

int read(byte channel) {
  ADMUX = _BV(REFS0) | (channel & 7);
  ADCSRA |= _BV(ADSC);
  while (ADCSRA & _BV(ADSC));
  return ADC;
}

void loop() {
  level = read(2) + read(3);
}
