#include "simpletools.h"

void spin(void)
{
  while (1) toggle(7);
}

int main()
{
  while (1) {
    int n = 0;
    while (1) {
      if (++n > 5) break;
      for (;;) { if (input(n)) break; }
    }
    if (n > 6) spin();
  }
}
