/* An infrared lamp, and a receiver that is low while it sees what comes back. */
#include "simpletools.h"

int main() {
  while (1) {
    freqout(11, 1, 38000);
    int seen = !input(10);
    set_output(26, seen);
    set_direction(26, 1);
    pause(50);
  }
}
