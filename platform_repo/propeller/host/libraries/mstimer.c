/* mstimer.h. Source: libmstimer/mstimer.c. */
#include "mstimer.h"

static volatile int milliseconds, cog;

static void count_up(void *unused) {
  (void)unused;
  for (unsigned next = CNT;;) {
    host_wait_counter(next += HOST_TICKS_PER_MS);
    milliseconds++;
  }
}

int mstime_start() {
  mstime_stop();
  return cog = host_start(count_up, 0, -1) + 1;
}

void mstime_stop() {
  host_call();
  if (cog) host_stop(cog - 1);
  cog = 0;
}

int mstime_get() {
  host_call();
  return milliseconds;
}

void mstime_reset() { mstime_set(0); }

void mstime_set(int newTime) {
  host_call();
  milliseconds = newTime;
}
