/* A cog keeps a beat by the counter while main polls a time of its own. */
#include "simpletools.h"

void beat(void *par)
{
  unsigned long t = CNT;
  long dt = CLKFREQ / 100;
  while (1)
  {
    waitcnt(t += dt);
    toggle(26);
  }
}

int main()
{
  long start;
  cog_run(beat, 10);
  start = CNT;
  while (CNT - start < CLKFREQ / 20);
  high(27);
  while (1) { if (CNT - start > CLKFREQ / 10) break; }
  low(27);
}
