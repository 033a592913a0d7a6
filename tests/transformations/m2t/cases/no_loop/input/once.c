#include "simpletools.h"

int main()
{
  int i;
  for (i = 0; i < 10; i++) {
    high(i);
    pause(100);
  }
}
