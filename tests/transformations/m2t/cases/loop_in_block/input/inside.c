#include "simpletools.h"

int main()
{
  int n = 0;
  if (input(1)) {
    while (1) { n++; }
  }
  {
    while (1) { pause(n); }
  }
}
