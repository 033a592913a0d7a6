/* A light sensor: how long its capacitor takes says how bright it is. */
#include "simpletools.h"

int main() {
  while (1) {
    high(9);
    pause(1);
    int dark = rc_time(9, 1) > 2000;
    if (dark) high(26);
    else low(26);
    pause(100);
  }
}
