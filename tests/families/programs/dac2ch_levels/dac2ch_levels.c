/* Two voltages of a converter of its own, one in steps of another size. */
#include "simpletools.h"
#include "dac2ch.h"

int main() {
  dac2ch *dac = dac2ch_start(10);
  dac2ch_set(dac, 26, 0, 256);
  dac2ch_set(dac, 27, 1, 768);
  pause(30);
  dac2ch_set(dac, 26, 0, 512);
  pause(30);
  dac2ch_set(dac, 26, 0, -1);
  pause(30);
  dac2ch_stop(dac);
}
