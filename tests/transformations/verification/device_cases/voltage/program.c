/* Two voltages one after the other, as pulses that a filter makes even. */
#include "simpletools.h"

int main() {
  dac_ctr(26, 0, 64);
  pause(800);
  dac_ctr(26, 0, 194);
  pause(800);
}
