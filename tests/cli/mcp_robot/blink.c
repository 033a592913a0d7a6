#include "simpletools.h"

int main()
{
  for (int n = 0; n < 3; n++) {
    high(26);
    pause(200);
    low(26);
    pause(150);
  }
}
