#include "simpletools.h"

int total;

int main()
{
  int a = 1, b = 2;
  total = a + b;
  while (1) {
    pause(total);
  }
}
