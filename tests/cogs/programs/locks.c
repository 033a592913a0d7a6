/* Two cogs take turns with a lock: what happens under it is never interrupted. */
#include "simpletools.h"

int lock;
volatile int inside, worst, done;

void taker(void *par)
{
  int i;
  for (i = 0; i < 5; i++)
  {
    while (lockset(lock));
    inside++;
    pause(3);
    if (inside > worst) worst = inside;
    inside--;
    lockclr(lock);
    pause(1);
  }
  done++;
}

int main()
{
  lock = locknew();
  cog_run(taker, 20);
  cog_run(taker, 20);
  while (done < 2) pause(1);
  print("done %d, worst %d\n", done, worst);
  return 0;
}
