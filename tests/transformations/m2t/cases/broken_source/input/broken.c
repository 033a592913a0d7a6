#include "simpletools.h"

int main()
{
  int n = 0
  while (1) {
    high(1);
    pause(n);
  }
}
