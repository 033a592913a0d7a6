//# header sys/unistd.h
// Waiting. Read from propgcc b280e7a77, lib/include/sys/unistd.h, lib/time/sleep.c and usleep.c. avr-libc has neither.

//# type useconds_t
//#   fidelity: exact
typedef uint32_t useconds_t;

//# adapter sleep
//#   for: unsigned int sleep(unsigned int seconds)
//#   kind: oneToMany
//#   fidelity: within 0.1 %; the answer is 0
inline uint32_t sleep(uint32_t seconds) {
  for (; seconds; seconds--) delay(1000);
  return 0;
}

//# adapter usleep
//#   for: int usleep(useconds_t usec)
//#   kind: semantic
//#   fidelity: within 8 us; the answer is 0
inline int32_t usleep(uint32_t usec) {
  for (uint32_t begun = micros(); micros() - begun < usec;) yield();
  return 0;
}
