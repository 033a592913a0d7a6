#include "simpletools.h"

#define FAST 1

#if FAST
#define DELAY 10
static int step(int n) { return n * 2; }
#else
#define DELAY 100
static int step(int n) { return n; }
#endif

#ifdef DEBUG
#include <stdio.h>
int debugLevel = 1;
#endif

int main()
{
  int n = 1;
  while (1) {
    n = step(n);
    pause(DELAY);
  }
}
