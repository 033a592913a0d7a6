/* Pulses that a pin sends, in units of one and of ten microseconds, and widths that are measured. */
#include "simpletools.h"

int out = 5, in = 4;

void send() {
  low(out);
  pulse_out(out, 250);
  pause(5);
  high(out);
  pulse_out(out, 400);
  pause(5);
  low(out);
  set_io_dt(CLKFREQ / 100000);
  pulse_out(out, 30);
}

int main() {
  send();
  print("%d\n", pulse_in(in, 1));
  set_io_dt(CLKFREQ / 1000000);
  print("%d\n", pulse_in(in, 0));
  print("%d\n", pulse_in(in, 1));
  print("%d\n", count(in, 100));
}
