#include "simpletools.h"

int ticks;

int main()
{
  ticks = 1;
  while (1)
    toggle(26);
}
