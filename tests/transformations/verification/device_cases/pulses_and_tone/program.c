/* Pulses of growing width, then a tone at the same pin, and a single pulse. */
#include "simpletools.h"

int main() {
  int i;
  pause(100);
  for (i = 0; i < 8; i++) {
    pulse_out(14, 100 * (i + 1));
    pause(20);
  }
  pause(300);
  square_wave(14, 0, 440);
  pause(300);
  square_wave_stop();
  pause(300);
  pulse_out(14, 500);
}
