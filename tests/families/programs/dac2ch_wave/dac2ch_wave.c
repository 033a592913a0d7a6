/* A triangle of voltages around the middle. */
#include "simpletools.h"
#include "dac2ch.h"

#define OUT 27

int values[] = {64, 128, 192, 128};

int main() {
  dac2ch *d = dac2ch_start(8);
  for (int n = 0; n < 4; n++) {
    dac2ch_set(d, OUT, 0, values[n]);
    pause(25);
  }
  dac2ch_stop(d);
  pause(25);
}
