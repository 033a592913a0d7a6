#include "simpletools.h"

static count;
extern ready();
ready();

add(a, b)
int a;
int b;
{
  return a + b;
}

float scale(x, factor)
  float x;
  float factor;
{
  return x * factor;
}

nothing() { count = 1; }

main()
{
  nothing();
  while (1) {
    count = add(count, 1);
    pause((int)scale(count, 2.0));
  }
}

ready() { return 1; }
