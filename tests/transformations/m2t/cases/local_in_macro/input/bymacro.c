#include "simpletools.h"
#define STEP(n) total += (n)

int main()
{
  int total = 0;
  while (1) {
    STEP(2);
    pause(10);
  }
}
