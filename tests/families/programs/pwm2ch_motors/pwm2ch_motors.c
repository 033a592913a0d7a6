/* Two motors by pulses of 1 ms cycles, one of which is let go. */
#include "simpletools.h"
#include "pwm2ch.h"

pwm2ch *motors;

int main() {
  motors = pwm2ch_start(1000);
  pwm2ch_set(motors, 3, 0, 300);
  pwm2ch_set(motors, 4, 1, 700);
  pause(40);
  pwm2ch_set(motors, 3, 0, 900);
  pause(40);
  pwm2ch_set(motors, 3, 0, -1);
  pause(20);
  pwm2ch_stop(motors);
}
