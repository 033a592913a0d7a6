#include "simpletools.h"

int main()
{
  int a = 1, b = 2, *p = &a;
  while (1) {
    a = a + b;
    *p = 3;
    pause(a);
  }
}
