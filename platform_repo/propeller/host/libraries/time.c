/* time.h, sys/time.h and the waits of unistd.h. There is no clock that runs without power: time begins at 0. */
#include <sys/time.h>
#include <time.h>
#include <unistd.h>
#include "host.h"

static time_t offset;

clock_t clock(void) {
  host_call();
  return (clock_t)host_now();
}

time_t time(time_t *to) {
  host_call();
  time_t now = offset + (time_t)(host_now() / HOST_HZ);
  return to ? *to = now : now;
}

double difftime(time_t end, time_t start) { return end - start; }

int gettimeofday(struct timeval *to, void *zone) {
  (void)zone;
  host_call();
  to->tv_sec = offset + (time_t)(host_now() / HOST_HZ);
  to->tv_usec = (long)(host_now() % HOST_HZ / HOST_TICKS_PER_US);
  return 0;
}

int settimeofday(const struct timeval *from, const void *zone) {
  (void)zone;
  host_call();
  offset = from->tv_sec - (time_t)(host_now() / HOST_HZ);
  return 0;
}

unsigned int sleep(unsigned int seconds) {
  host_sleep_until(host_now() + (host_time)seconds * HOST_HZ);
  return 0;
}

int usleep(useconds_t microseconds) {
  host_sleep_until(host_now() + (host_time)microseconds * HOST_TICKS_PER_US);
  return 0;
}
