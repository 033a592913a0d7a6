#include "simpletools.h"
const int lamp = 31;

int main(void)
{
  high(lamp);
  low(0);
  square_wave(-26, 0, 0);
  pause(36);
  OUTA |= 1 << 31;
  OUTA = ~0;
}
