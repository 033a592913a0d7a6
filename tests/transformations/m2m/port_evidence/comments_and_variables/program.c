#include "simpletools.h"

int main()
{
  int lightRight = 0, lightLeft;
  while (1)
  {
    // the green lamp
    high(3);
    high(4);   /* red */
    high(5);
    lightLeft = rc_time(9, 1);
    lightRight = (int) rc_time(7, 1);
    pause(lightLeft + lightRight);
  }
}
