#include "simpletools.h"
#include "shared.h"

struct point { int x; char name; };
extern int first, second;
extern int *place, numbers[], grid[2][3], (*chosen)(int);
extern struct point here, there[2];
extern const int limit, others[2];
extern volatile int stop, known;
volatile int known = 3;
int half(int), sum(int, char *);
extern int ready(void), count;

int own(void)
{
  extern int inner, outer;
  return inner + outer;
}

int main()
{
  work();
  print("%d %d", first + second + *place + numbers[1] + grid[1][1] + chosen(2) + here.x + there[1].x + limit, others[1]);
  print("%d %d", stop + known + half(2) + sum(3, "a") + ready() + count + own(), total + table[1] + step);
  return 0;
}
