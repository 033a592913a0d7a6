void setup() {
  DDRB |= 1;
}

void loop() {
  PORTB |= 1;
  DDRB &= ~1;
  DDRB |= 1;
  PORTB &= ~1;
}

void set(volatile uint8_t *port) { *port |= 4; }

void other() { set(&PORTC); }
