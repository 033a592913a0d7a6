void setup() {
  pinMode(8, OUTPUT);
}

void loop() {
  PORTB |= 1;
  pinMode(8, INPUT);
  pinMode(8, OUTPUT);
  PORTB &= ~1;
}

void set(volatile uint8_t *port) { *port |= 4; }

void other() { set(&PORTC); }
