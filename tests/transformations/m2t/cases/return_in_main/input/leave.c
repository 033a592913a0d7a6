#include "simpletools.h"

int state(void) { return input(4); }

int main()
{
  if (input(3) == 0) return 1;
  high(5);
  if (input(6)) {
    low(5);
    return state();
  }
  return 0;
}
