#include "BareRegisters.h"

#define OWN_MASK 3
#define PORTL OWN_MASK

static volatile unsigned char count;

void begin_pulses()
{
  // TCCR3A = 1 is only a comment
  TCCR1A = 0;
  DDRB |= OWN_MASK;
  count = PORTL & OWN_MASK;
}

ISR(TIMER1_COMPA_vect) { count++; }
