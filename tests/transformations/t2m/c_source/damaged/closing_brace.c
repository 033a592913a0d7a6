#include "simpletools.h"

int blink()
{
  while (input(1))
  {
    high(2);
}

int main()
{
  blink();
  low(3);
}
