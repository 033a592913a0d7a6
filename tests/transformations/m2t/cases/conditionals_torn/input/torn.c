#include "simpletools.h"

int main()
{
  high(1);
#ifndef ONCE
  while (1) {
#else
  {
#endif
    toggle(1);
  }
}
