// A photocell at A2, read by the registers of the converter, switches a lamp.
void setup() {
  pinMode(8, OUTPUT);
  ADMUX = (1 << REFS0) | 2;
  ADCSRA = (1 << ADEN) | (1 << ADPS2) | (1 << ADPS1) | (1 << ADPS0);
}

void loop() {
  ADCSRA |= (1 << ADSC);
  while (ADCSRA & (1 << ADSC)) {}
  digitalWrite(8, ADC > 500);
  delay(5);
}
