#include <avr/io.h>
#include <avr/interrupt.h>
volatile unsigned long ticks = 0;

ISR(TIMER1_COMPA_vect) {
  ticks++;
}

void setup() {
  cli();
  TCCR1A = 0;
  TCCR1B = 0;
  TCNT1 = 0;
  OCR1A = 15624;
  TCCR1B |= (1 << WGM12);
  TCCR1B |= (1 << CS12) | (1 << CS10);
  TIMSK1 |= (1 << OCIE1A);
  sei();
}

void loop() {
  noInterrupts();
  unsigned long now = ticks;
  interrupts();
  if (now > 10) delay(1);
}
