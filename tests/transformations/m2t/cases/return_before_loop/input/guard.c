#include "simpletools.h"

int main()
{
  if (!input(3))
    return 1;
  while (1) {
    toggle(5);
    pause(50);
  }
  return 0;
}
