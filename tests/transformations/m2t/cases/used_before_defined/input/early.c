#include "simpletools.h"

static int stack[40];

void go(void) {
  helper(3);
  cog_run(worker, 40);
}

int main()
{
  go();
  while (1) pause(1000);
}

int helper(int n) { return n + stack[0]; }

void worker(void *par)
{
  while (1) { toggle(4); }
}
