#include "simpletools.h"

int main()
{
  while (input(1))
  {
    high(2);
  }
  }
  low(3);
  pause(4);
}

int more()
{
  return input(5);
}
