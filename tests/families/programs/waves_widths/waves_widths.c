/* Two motors at pulses of other widths, then a light that is dimmed, and its steps of another size. */
#include "simpletools.h"

int main() {
  pwm_start(2000);
  pwm_set(4, 0, 500);
  pwm_set(5, 1, 1200);
  pause(40);
  pwm_set(4, 0, 1500);
  pause(40);
  pwm_stop();
  pause(40);
  for (int level = 64; level <= 192; level += 64) {
    dac_ctr(26, 0, level);
    pause(30);
  }
  dac_ctr_res(4);
  dac_ctr(26, 0, 4);
  pause(30);
  dac_ctr_stop();
  pause(20);
}
