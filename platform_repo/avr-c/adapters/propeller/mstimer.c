//# header mstimer.h
// A clock of milliseconds, in C. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Misc/libmstimer (mstimer.h, mstimer.c).

//# helper mstime_origin
//#   ram: 8
static uint32_t mstime_origin;
static int32_t mstime_held;  // what it shows while it stands

//# helper mstime_on
//#   ram: 1
static bool mstime_on;

//# adapter mstime_get
//#   for: int mstime_get()
//#   kind: oneToOne
//#   needs: mstime_origin mstime_on propeller.h/clock_ms
//#   fidelity: milliseconds since the start, up to 2 ms late; the resonator of an Uno is up to 0.5 % off
static inline int32_t mstime_get(void) {
  return mstime_on ? (int32_t)(clock_ms() - mstime_origin) : mstime_held;
}

//# adapter mstime_set
//#   for: void mstime_set(int newTime)
//#   kind: oneToOne
//#   needs: mstime_origin propeller.h/clock_ms
//#   fidelity: exact
static inline void mstime_set(int32_t newTime) {
  mstime_held = newTime;
  mstime_origin = clock_ms() - newTime;
}

//# adapter mstime_reset
//#   for: void mstime_reset()
//#   kind: oneToOne
//#   needs: mstime_set
//#   fidelity: exact
static inline void mstime_reset(void) {
  mstime_set(0);
}

//# adapter mstime_start
//#   for: int mstime_start()
//#   kind: oneToOne
//#   needs: mstime_on mstime_set
//#   fidelity: from 0; the answer is the number of a cog, always 1 here
static inline int32_t mstime_start(void) {
  mstime_set(0);
  mstime_on = true;
  return 1;
}

//# adapter mstime_stop
//#   for: void mstime_stop()
//#   kind: oneToOne
//#   needs: mstime_origin mstime_on mstime_get
//#   fidelity: the time stands
static inline void mstime_stop(void) {
  mstime_held = mstime_get();
  mstime_on = false;
}
