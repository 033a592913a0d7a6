#include "simpletools.h"

int main()
{
  struct point { int x; int y; };
  struct point p = {1, 2};
  while (1) {
    p.x += p.y;
    pause(p.x);
  }
}
