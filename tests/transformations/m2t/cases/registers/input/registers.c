#include <propeller.h>

#define LED (1 << 5)

int main()
{
  unsigned int next = CNT + CLKFREQ / 10;
  DIRA |= LED;
  OUTA &= ~LED;
  while (1) {
    OUTA ^= LED;
    if (INA & 1) FRQA = 5;
    next += CLKFREQ / 2;
    waitcnt(next);
  }
}
