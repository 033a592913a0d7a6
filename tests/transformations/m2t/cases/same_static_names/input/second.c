#include "simpletools.h"

static int state = 100;
static int next(void) { return state--; }

int other(void)
{
  toggle(CNT & 1);
  return next();
}
