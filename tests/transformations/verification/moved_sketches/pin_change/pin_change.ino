// A wheel's sensor at pin 5 counts by a pin change interrupt; every second change toggles a lamp.
volatile byte changes = 0;

ISR(PCINT2_vect) {
  changes++;
}

void setup() {
  pinMode(5, INPUT);
  pinMode(12, OUTPUT);
  PCICR |= (1 << PCIE2);
  PCMSK2 |= (1 << PCINT21);
}

void loop() {
  digitalWrite(12, (changes >> 1) & 1);
  delay(2);
}
