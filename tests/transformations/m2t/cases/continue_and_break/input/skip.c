#include "simpletools.h"

int mode;

int main()
{
  high(1);
  while (1) {
    int i;
    if (input(2)) continue;
    for (i = 0; i < 4; i++) {
      if (i == 2) continue;
      if (i == 3) break;
      toggle(i);
    }
    switch (mode) {
      case 0:
        mode = 1;
        break;
      default:
        continue;
    }
    pause(20);
  }
}
