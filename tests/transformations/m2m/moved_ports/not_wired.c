// bind P5=none
// expect D9=1
#include "simpletools.h"
int main() {
  freqout(5, 20, 1000); long t = rc_time(5, 1); int p = pulse_in(5, 1); int n = count(5, 5); pulse_out(5, 100); square_wave(5, 0, 1000);
  pwm_start(1000); pwm_set(5, 0, 300); pwm_stop(); toggle(5); int s = shift_in(5, 5, MSBPRE, 8); shift_out(5, 5, LSBFIRST, 8, 3); dac_ctr(5, 0, 20);
  if (t == 0 && p == 0 && n == 0 && s == 0 && !input(5)) { high(0); pause(1); low(0); }
  while (1);
}
