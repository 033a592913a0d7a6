#include <stdio.h>
#include "simpletools.h"

typedef struct point { int x, y; unsigned char flags : 3; struct point *next; } point_t;
enum mode { OFF_MODE, SLOW = 4, FAST };
union either { float f; long i; };

/* how many */
static unsigned long counter = 0x10UL;
const char *names[3] = { "a", "b" "c", [2] = "d" }; // the names
int a, *b, grid[4][2];
volatile double speed = 1.5e3;
int (*handler)(int, char *);

int next(point_t *p, ...);

static int sum(const int values[], unsigned n)
{
  int total = 0, i;
  for (i = 0; i < (int)n; i++) total += values[i];
  for (;;) { if (total > 10) break; else total++; }
  do { total -= 2; } while (total > 5);
  while (1) { goto out; }
out:
  switch (total) {
    case 1:
    case 'x': total = -total; break;
    default: ;
  }
  return n ? total : sizeof(point_t);
}

int next(point_t *p, ...)
{
  point_t q = { .x = 1, .y = ~2 };
  p->x = q.y, p->next->y++;
  handler(3, "s");
  return !sum(&a, sizeof a) && (p->flags & 3) != 0 ? 1 : *b;
}
