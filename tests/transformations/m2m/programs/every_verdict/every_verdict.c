// One program in which every rule on dispositions has something to say.
#include "simpletools.h"
#include <math.h>
#ifndef QUIET
#include <stdio.h>
#endif
#include <fcntl.h>
#include "nowhere.h"
#include "wheel.h"
#define TICKS 3

int main();
int helper(int turns);
int speed = TICKS, interrupts = 1;

int helper(int turns)
{
  char *name = "wheel";
  return turns * wheels + spin(1) + lift(2) + sqrt(4) + *name + SPOKES;
}

int main()
{
  int start = 1;
  int count = input(3);
  high(start);
  while (1)
  {
    count = helper(count) + CNT;
    if (count) continue;
    pause(100 + start);
  }
  low(26);
}
