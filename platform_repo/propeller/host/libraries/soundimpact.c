/* soundimpact.h: a cog looks at the pin. Source: libsoundimpact/soundimpact.c. */
#include "soundimpact.h"

static volatile int impacts, watched;

static void watch(void *unused) {
  (void)unused;
  int pin = watched;
  unsigned mask = 1u << pin;
  input(pin);
  for (;;) {
    host_wait_pins(mask, 0, 1, HOST_NEVER);
    host_wait_pins(mask, mask, 1, HOST_NEVER);
    impacts++;
  }
}

int *soundImpact_run(int pin) {
  watched = pin;
  return cog_run(watch, 20);
}

void soundImpact_end(int *processID) { cog_end(processID); }

int soundImpact_getCount(void) {
  int seen = impacts;
  host_call();
  impacts -= seen;
  return seen;
}
