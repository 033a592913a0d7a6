#include "simpletools.h"
#include "shared.h"

static int own_speed = 4;
extern int first, second;
extern volatile int stop;
int step = 2;

void work(void)
{
  first = own_speed;
  second = step;
  total = table[0];
  stop = 1;
}
