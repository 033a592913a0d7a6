#include "simpletools.h"

int main()
{
  while (1) {
    toggle(1);
  }
  // never reached
  low(1);
  return 0;  /* nor this */
}
