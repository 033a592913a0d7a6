#include "simpletools.h"

int main()
{
  high(1;
  if (input(2) low(3);
  while (input(4) { pause(5); }
  print("%d", (input(6));
}
