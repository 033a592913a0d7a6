#include "simpletools.h"

int main()
{
  while (1) {
    step(1);
    delete(2);
    add(1, 2);
    pause(shift(3));
  }
}

static void step(int n) /* once */ { high(n); }
int delete(int new) { return new; }
add(a, b) int a; int b; { return a + b; }
unsigned long  shift(unsigned char  n)   // by one
{
  return n << 1;
}
