int level;

void setup() {
  ADMUX = _BV(REFS0) | 2;
  ADCSRA = _BV(ADEN) | _BV(ADPS2) | _BV(ADPS1) | _BV(ADPS0);
}

void loop() {
  ADCSRA |= _BV(ADSC);
  while (ADCSRA & _BV(ADSC));
  level = ADC;
  delay(level / 4);
}
