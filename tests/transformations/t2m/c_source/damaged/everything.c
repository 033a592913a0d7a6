#include "simpletools.h"

int pins[2] = {3, 4;

void go(int pin
{
  high(pin)
  pause 100);
}

int main()
{
  go(pins[0]);
  while (1)
  {
    go(pins[1])
    print("%d\n", input(5);
  }
