#include "propeller.h"

int main()
{
  int mask = 0x3fffffff;
  DIRA = mask;
  while (1) {
    OUTA ^= DIRA;
    waitcnt(CNT + CLKFREQ / 2);
  }
}
