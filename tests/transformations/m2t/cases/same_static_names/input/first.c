#include "simpletools.h"

static int state = 1;
static int next(void) { return state++; }
int other(void);

int main()
{
  while (1) {
    pause(next() + other());
  }
}
