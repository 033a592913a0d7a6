/* A cog ends by itself and is started anew; there is never more than one beside main. */
#include "simpletools.h"

volatile int runs;

void once(void *par)
{
  toggle(26);
  pause(5);
  runs++;
}

int main()
{
  int *cog;
  int i;
  for (i = 1; i <= 4; i++)
  {
    cog = cog_run(once, 10);
    while (runs < i) pause(1);
    cog_end(cog);
  }
  print("%d runs\n", runs);
  while(1);
}
