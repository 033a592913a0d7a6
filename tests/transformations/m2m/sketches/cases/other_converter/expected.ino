int level;

void setup() {
  ADCSRA = bit(ADEN) | 7;
}

int read(byte channel) {
  ADMUX = bit(REFS0) | (channel & 7);
  ADCSRA |= bit(ADSC);
  while (ADCSRA & bit(ADSC));
  return ADC;
}

void loop() {
  level = read(2) + read(3);
}
