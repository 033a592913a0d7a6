#include "simpletools.h"

int main()
{
  if (input(1)) high(2); low(3);
  else pause(4);
  toggle(5);
}
