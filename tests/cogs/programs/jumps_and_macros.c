/* main waits by jumping back, in a loop whose head is a macro, and in macros that are loops. */
#include "simpletools.h"

#define FOR_EVER while (1)
#define UNTIL(x) while (!(x))
#define AWAIT(n) do { turns++; } while (flag < (n))
#define UNTIL_OR_TURN(n) \
  for (; flag < (n);) { \
    turns++; \
  }

volatile int flag;
volatile unsigned turns;

void worker(void *par)
{
again:
  toggle(26);
  pause(20);
  flag++;
  goto again;
}

int main()
{
  cog_run(worker, 40);
wait:
  if (flag < 2)
    goto wait;
  high(27);
  UNTIL(flag >= 4);
  low(27);
  AWAIT(6);
  high(27);
  UNTIL_OR_TURN(8)
  low(27);
  print("%d %d\n", flag >= 8, turns > 10);
  FOR_EVER {
    turns++;
  }
}
