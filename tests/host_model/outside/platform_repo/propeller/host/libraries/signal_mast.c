#include "signal_mast.h"
#include "simpletools.h"

int mast_show(int lamp, int on) {
  if (lamp < 0 || lamp >= MAST_LAMPS) return 0;
  if (on) high(20 + lamp); else low(20 + lamp);
  return 1;
}
