#include "simpletools.h"

typedef enum { NORTH, EAST, SOUTH, WEST } heading;
enum color { RED, GREEN } paint = RED;
heading now = NORTH;

heading turn(heading h) { return (h + 1) % 4; }

int main()
{
  heading h;
  while (1) {
    now++;
    now += 1;
    h = now--;
    --h;
    for (h = NORTH; h <= WEST; h++) pause(h);
    paint = !paint;
    now = turn(h) | 1;
    if (now == 2) now = h;
  }
}
