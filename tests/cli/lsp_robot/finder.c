#include "simpletools.h"

int irLeft = 10;

int main()
{
  while (1) {
    if (input(irLeft)) high(26); else low(26);
    pause(50);
  }
}
