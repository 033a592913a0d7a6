volatile byte changes;

ISR(PCINT2_vect) {
  changes++;
}

void setup() {
  PCICR |= (1 << PCIE2);
  PCMSK2 |= (1 << PCINT20) | _BV(PCINT21);
  pinMode(4, INPUT_PULLUP);
}

void loop() {
  if (changes > 10) changes = 0;
}
