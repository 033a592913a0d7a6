/* ping.h. Source: libping/ping.c. */
#include "ping.h"

int ping(int pin) {
  pause(1);
  low(pin);
  pulse_out(pin, 10);
  return pulse_in(pin, 1);
}

int ping_cm(int pin) { return ping(pin) / 58; }

int ping_inches(int pin) { return ping(pin) / 148; }
