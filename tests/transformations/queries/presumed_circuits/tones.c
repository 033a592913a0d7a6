#include "simpletools.h"

int main() {
  while (1) {
    freqout(4, 500, 3000);
    freqout(11, 1, 38000);
    int seen = input(10);
    if (seen) high(26); else low(26);
    pause(rc_time(6, 1));
  }
}
