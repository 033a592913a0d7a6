#include "simpletools.h"

int main()
{
  while(1)
  {
    high(26);
    pause(100);
    low(26);
    pause(100);
  }
}
