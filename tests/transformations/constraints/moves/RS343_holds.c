#include "simpletools.h"
/* Loops that are left, functions that come back on some way, and labels that are gone to. */
int count;
void once(void) { while (1) { if (count++ > 3) break; } }
void back(void) { for (;;) { if (count++ > 3) return; } }
void some(int way) { if (way) while (1) toggle(3); }
void early(void) { if (count) return; while (1) toggle(3); }
void far(void) { for (;;) { if (count++ > 3) goto out; } out: toggle(4); }
void stay(void) { while (1) toggle(3); }

int main(void)
{
  once();
  back();
  some(0);
  early();
  far();
  if (count == 9) goto later;
  if (count > 100) stay();
  while (count < 7) { if (count == 5) break; stay(); }
  stay();
later:
  high(5);
}
