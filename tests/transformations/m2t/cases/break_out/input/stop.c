#include "simpletools.h"

int main()
{
  while (1) {
    if (input(2)) break;
    toggle(3);
  }
  low(3);
  return 0;
}
