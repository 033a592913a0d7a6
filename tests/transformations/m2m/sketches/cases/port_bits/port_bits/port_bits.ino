#include <avr/io.h>

void setup() {
  DDRB |= _BV(5) | (1 << PB4);
  DDRD &= ~(1 << 2);
  PORTD |= (1 << PD2);
}

void loop() {
  if (PIND & (1 << PD2)) PORTB |= (1 << 4);
  else PORTB &= ~(1 << PB4);
  PORTB ^= _BV(PB5);
  PINB = _BV(5);
  delay(100);
}
