//# header sys/time.h
// The time of day. Read from propgcc b280e7a77, lib/include/sys/time.h, lib/sys/propeller/rtc.c, lib/time/gettimeofday.c and settimeofday.c.

//# type timeval
//#   include: <sys/time.h>
//#   fidelity: that of the C library of this target, with the same members
static_assert(sizeof(timeval) >= 8, "timeval has seconds and microseconds");

//# type timeval
//#   architecture: avr
//#   include: <time.h>
//#   fidelity: exact
struct timeval {
  time_t tv_sec;
  uint32_t tv_usec;
};

//# type suseconds_t
//#   include: <sys/time.h>
//#   fidelity: that of the C library of this target
static_assert(sizeof(suseconds_t) >= 4, "suseconds_t holds microseconds");

//# type suseconds_t
//#   architecture: avr
//#   fidelity: exact
typedef uint32_t suseconds_t;

//# adapter gettimeofday
//#   for: int gettimeofday(struct timeval *tv, void *unused)
//#   kind: semantic
//#   name: c_gettimeofday
//#   needs: timeval time.h/clock_base time.h/clock_us
//#   fidelity: as time, with microseconds in steps of 4
//#   stack: 34 14
inline int32_t c_gettimeofday(timeval *tv, const void *) {
  uint64_t us = clock_us() - clock_set_at;
  tv->tv_sec = clock_base + (time_t)(us / 1000000);
  tv->tv_usec = (uint32_t)(us % 1000000);
  return 0;
}

//# adapter gettimeofday
//#   architecture: avr
//#   for: int gettimeofday(struct timeval *tv, void *unused)
//#   kind: semantic
//#   needs: timeval time.h/clock_base time.h/clock_us
//#   fidelity: as time, with microseconds in steps of 4
//#   stack: 34 14
inline int32_t gettimeofday(timeval *tv, const void *) {
  uint64_t us = clock_us() - clock_set_at;
  tv->tv_sec = clock_base + (time_t)(us / 1000000);
  tv->tv_usec = (uint32_t)(us % 1000000);
  return 0;
}

//# adapter settimeofday
//#   for: int settimeofday(const struct timeval *tv, const void *unused)
//#   kind: semantic
//#   name: c_settimeofday
//#   needs: timeval time.h/clock_base time.h/clock_us
//#   fidelity: exact; the microseconds are not looked at, as there
//#   stack: 2 0
inline int32_t c_settimeofday(const timeval *tv, const void *) {
  clock_set_at = clock_us();
  clock_base = tv->tv_sec;
  return 0;
}

//# adapter settimeofday
//#   architecture: avr
//#   for: int settimeofday(const struct timeval *tv, const void *unused)
//#   kind: semantic
//#   needs: timeval time.h/clock_base time.h/clock_us
//#   fidelity: exact; the microseconds are not looked at, as there
//#   stack: 2 0
inline int32_t settimeofday(const timeval *tv, const void *) {
  clock_set_at = clock_us();
  clock_base = tv->tv_sec;
  return 0;
}
