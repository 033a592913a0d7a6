#include "simpletools.h"

int main()
{
  int x = 1;
  if x == 1) high(1);
  while x) { low(2); }
  pause(3);
}
