// Two lamps and a button by registers.
#define BUTTON PD2

void setup() {
  DDRB |= (1 << DDB5) | (1 << DDB0);
  DDRD &= ~(1 << BUTTON);
  PORTD |= (1 << BUTTON);
}

void loop() {
  if (PIND & (1 << BUTTON)) {
    PORTB &= ~_BV(PB0);
  } else {
    PORTB |= _BV(PB0);
  }
  PINB = _BV(PB5);
  delay(20);
}
