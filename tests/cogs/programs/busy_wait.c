/* main waits for a flag in a loop without a body, and in one that counts. */
#include "simpletools.h"

volatile int flag;
volatile unsigned turns;

void worker(void *par)
{
  int n = 0;
  while (1)
  {
    toggle(26);
    pause(20);
    if (++n == 5) flag = 1;
    if (n == 10) flag = 2;
  }
}

int main()
{
  cog_run(worker, 40);
  while (!flag);
  high(27);
  while (flag != 2)
    turns++;
  low(27);
  print("%d %d\n", flag, turns > 10);
  while (1);
}
