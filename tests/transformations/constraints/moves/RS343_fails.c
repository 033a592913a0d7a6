#include "simpletools.h"
/* What stands behind functions that never return, directly, through others, on all branches, or in blocks. */
void stay(void);
static void around(int way) { print("%d", way); stay(); }
void either(int way) { if (way) stay(); else { around(way); } }

int main(void)
{
  int way = 3;
  if (way > 2) {
    either(way);
    high(4);  // RS343: high(4);
    low(4);
  }
  around(way);
  high(5);  // RS343: high(5);
}

void stay(void)
{
  int i;
  while (1) {
    for (i = 0; i < 3; i++) { if (i == 2) break; toggle(3); }
  }
}
