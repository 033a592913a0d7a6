#include "simpletools.h"

int main()
{
  int n = 0;
  while (1) {
    switch (n) {
      case 0:
        n = 1;
        int twice = 2 * n;
        pause(twice);
        break;
      default:
        n = 0;
    }
  }
}
