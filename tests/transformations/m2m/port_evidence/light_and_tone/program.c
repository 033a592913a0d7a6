#include "simpletools.h"

int irLeft, irRight;

int main()
{
  low(26);
  low(27);
  while (1)
  {
    freqout(11, 1, 38000);                   // LED for left IR
    irLeft = input(10);
    freqout(1, 1, 38000);
    irRight = !input(2);
    freqout(4, 100, 3000);
    pause(100);
  }
}
