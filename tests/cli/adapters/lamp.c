#include "simpletools.h"
#include "s3.h"

int main()
{
  s3_setVolume(7);
  while (1)
  {
    high(9);
    pause(200);
    low(9);
    pause(200);
  }
}
