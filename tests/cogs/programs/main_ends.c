/* main is over at once; the cog goes on. */
#include "simpletools.h"

void blink(void *par) { while (1) { toggle(26); pause(10); } }

int main()
{
  cog_run(blink, 10);
  if (input(5) == 0) return 1;
  high(27);
  return 0;
}
