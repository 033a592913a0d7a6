// Pulses are counted in an interrupt and read in a block without interrupts.
#include <util/atomic.h>
#include <util/delay.h>

volatile unsigned int pulses = 0;

void count() { pulses++; }

void setup() {
  pinMode(2, INPUT_PULLUP);
  DDRB |= _BV(4);
  attachInterrupt(digitalPinToInterrupt(2), count, FALLING);
  sei();
}

void loop() {
  unsigned int now;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { now = pulses; }
  if (now & 1) PORTB |= _BV(4);
  else PORTB &= ~_BV(4);
  _delay_ms(2);
}
