//# header time.h
// Clock ticks and seconds. Read from propgcc b280e7a77, lib/include/time.h, lib/sys/propeller/clock.c and rtc.c, lib/time/time.c and
// difftime.c. avr-libc declares clock without a body, and has no clock behind its time.

//# type clock_t
//#   include: <time.h>
//#   fidelity: exact: 32 bits without a sign
static_assert(sizeof(clock_t) == 4 && (clock_t)-1 > 0, "clock_t is that in time.h");

//# type time_t
//#   include: <time.h>
//#   fidelity: exact: 32 bits without a sign
static_assert(sizeof(time_t) == 4 && (time_t)-1 > 0, "time_t is that in time.h");

//# constant CLOCKS_PER_SEC
//#   include: <time.h>
//#   fidelity: exact: ticks of the virtual counter in a second
#undef CLOCKS_PER_SEC
#define CLOCKS_PER_SEC ((clock_t)80000000UL)

//# constant CLK_TCK
//#   include: <time.h>
//#   fidelity: exact: ticks of the virtual counter in a second
#define CLK_TCK ((clock_t)80000000UL)

//# adapter clock
//#   for: clock_t clock(void)
//#   for: unsigned int clock(void)
//#   kind: oneToOne
//#   name: c_clock
//#   needs: propeller.h/CNT
//#   include: <time.h>
//#   fidelity: the virtual counter, in steps of 4 us; it comes round after 53.7 s, as there
inline clock_t c_clock() {
  return CNT;
}

//# helper clock_base
//#   include: <time.h>
//#   fidelity: what the clock was set to, and when
//#   ram: 12
static time_t clock_base;  // seconds
static uint64_t clock_set_at;  // microseconds since the program began

//# helper clock_us
//#   fidelity: microseconds since the program began, for 49 days; there they are lost when nobody asks for 53 s
inline uint64_t clock_us() {
  uint64_t us = (uint64_t)millis() * 1000;
  return us + (int32_t)(micros() - (uint32_t)us);
}

//# adapter time
//#   for: time_t time(time_t *tp)
//#   kind: semantic
//#   name: c_time
//#   needs: clock_base clock_us
//#   include: <time.h>
//#   fidelity: seconds since the clock was set, from what it was set to; since the program began, from 0, where nobody set it
inline time_t c_time(time_t *tp) {
  time_t now = clock_base + (time_t)((clock_us() - clock_set_at) / 1000000);
  if (tp) *tp = now;
  return now;
}

//# adapter difftime
//#   for: double difftime(time_t time2, time_t time1)
//#   kind: oneToOne
//#   name: c_difftime
//#   include: <time.h>
//#   fidelity: exact
inline double c_difftime(time_t time2, time_t time1) {
  return time1 <= time2 ? (double)(time2 - time1) : -(double)(time1 - time2);
}
