/* sirc.h: a start pulse of 2.4 ms, then bits by the width of low pulses, lowest first. It sets unit and time limit of pulse_in for
 * good. Source: libsirc/sirc.c. */
#include "sirc.h"

static unsigned limit_ticks;

void sirc_setTimeout(int ms) { limit_ticks = (unsigned)HOST_TICKS_PER_MS * ms; }

int sirc_code(int pin, int bits) {
  int code = 0;
  long width;
  unsigned begun = CNT;
  set_io_dt(HOST_TICKS_PER_US);
  set_io_timeout(HOST_HZ / 50);
  do {
    width = pulse_in(pin, 0);
    if (limit_ticks && CNT - begun >= limit_ticks) return -1;
  } while (width <= 2000 || width >= 2800);
  for (int bit = 0; bit < bits; bit++) {
    width = pulse_in(pin, 0);
    if (width > 1000 && width < 1400) code |= 1 << bit;
    if (width < 300 || width > 1400) return -1;
    if (limit_ticks && CNT - begun >= limit_ticks) return -1;
  }
  return code;
}

/* The keys 1 to 9 and 0 have the codes 0 to 9. */
int sirc_button(int pin) {
  int code = sirc_code(pin, 7);
  return code < 0 || code > 9 ? code : code == 9 ? 0 : code + 1;
}

int sirc_device(int pin) { return sirc_code(pin, 12) >> 7; }
