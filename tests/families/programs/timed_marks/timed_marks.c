/* Times: a mark that is looked at, waits that do not add up, a pause in another unit, and a charge that decays. */
#include "simpletools.h"

int main() {
  int turns = 0;
  low(8);
  mark();
  while (!timeout(25000))
    turns = 1;
  high(8);
  wait(40000);
  low(8);
  mark();
  for (int n = 0; n < 4; n++) {
    wait(10000);
    toggle(8);
    pause(3);
  }
  set_pause_dt(CLKFREQ / 10000);
  pause(50);
  high(8);
  set_pause_dt(CLKFREQ / 1000);
  int dark = 0;
  for (int n = 0; n < 3; n++) {
    high(9);
    pause(2);
    int t = rc_time(9, 1);
    print("%d ", t);
    if (t > 5000) dark++;
    pause(100);
  }
  print("%d %d\n", dark, turns);
}
