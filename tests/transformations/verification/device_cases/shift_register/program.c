/* A register of lamps that shows what another register reads. */
#include "simpletools.h"

#define LATCH 3
#define DATA 4
#define CLOCK 5
#define READ 6

int main() {
  low(LATCH);
  low(CLOCK);
  while (1) {
    int value = shift_in(READ, CLOCK, MSBPRE, 8);
    shift_out(DATA, CLOCK, MSBFIRST, 12, value << 4 | 9);
    pulse_out(LATCH, 500);
    print("%x\n", value);
    pause(200);
  }
}
