#include "simpletools.h"

typedef struct { int x; int y; } point;
struct robot { point where; };
typedef enum { SLOW, FAST } pace;

struct robot r;
point home;

int main()
{
  pace p = FAST;
  point *there = mystery_target();
  while (1) {
    mystery_move(&r, home, p);
    mystery_show(&home);
    pause(there->x);
  }
}
