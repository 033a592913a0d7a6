#include "simpletools.h"
#include "wheel.h"
int left_turns(int ticks) {
  if (ticks == 0) high(26);
  return ticks / TICKS_PER_TURN;
}
