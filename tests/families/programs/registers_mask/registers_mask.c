/* Lamps by bits of the registers of pins, in steps of the counter. */
#include "propeller.h"

#define LAMPS (0b111 << 4)
#define BUTTON (1 << 3)

int main() {
  unsigned t = CNT;
  DIRA |= LAMPS;
  OUTA = 0b001 << 4;
  for (int n = 0; n < 4; n++) {
    waitcnt(t += CLKFREQ / 50);
    OUTA = OUTA << 1 & LAMPS;
    if (!(OUTA & LAMPS)) OUTA |= 1 << 4;
  }
  waitpeq(BUTTON, BUTTON);
  OUTA &= ~LAMPS;
  waitpne(BUTTON, BUTTON);
  OUTA ^= LAMPS;
  DIRA &= ~(1 << 6);
}
