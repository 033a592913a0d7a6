/* Neither a cog that only computes nor a loop that only polls keeps the others waiting. */
#include "simpletools.h"

volatile unsigned sum;
volatile int stop;

void compute(void *par)
{
  unsigned n = 1;
  do {
    n = n * 3 + 1;
    sum += n & 1;
  } while (!stop);
  high(25);
  for (;;) ;
}

void watch(void *par)
{
  while (1)
    if (sum > 100) stop = 1;
}

int main()
{
  cog_run(compute, 10);
  cog_run(watch, 10);
  while (1)
  {
    toggle(26);
    pause(10);
  }
}
