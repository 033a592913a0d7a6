#include "simpletools.h"

int main()
{
  int i;
  for (i = 0; ; i++) {
    high(i % 8);
    pause(10);
  }
}
