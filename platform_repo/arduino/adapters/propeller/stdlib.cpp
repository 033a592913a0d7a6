//# header stdlib.h
// The end of a program, and random numbers. Read from propgcc b280e7a77, lib/include/stdlib.h, lib/stdlib/exit.c and rand.c. All else of
// the header is that of avr-libc, whose exit turns interrupts off, so that text that is on its way gets lost and servos, tones and jobs
// stand still, and whose random numbers are others: a program that never seeds them does the same after each reset, and shall here as well.

//# adapter exit
//#   for: void exit(int status)
//#   kind: semantic
//#   name: c_exit
//#   fidelity: the program rests for ever, while text on its way, servos and tones go on, as other cogs do there
//#   limit: functions given to atexit are not called, and nobody gets the status
//#   stack: 0
[[noreturn]] inline void c_exit(int32_t status) {
  (void)status;
  for (;;) yield();
}

//# helper rand_state
//#   ram: 4
static uint32_t rand_state = 0;

//# adapter srand
//#   for: void srand(unsigned int seed)
//#   kind: oneToOne
//#   name: c_srand
//#   needs: rand_state
//#   fidelity: exact
//#   limit: all cogs share one row of numbers; there each has its own
//#   stack: 0
inline void c_srand(uint32_t seed) {
  rand_state = seed;
}

//# adapter rand
//#   for: int rand(void)
//#   kind: oneToOne
//#   name: c_rand
//#   needs: rand_state
//#   fidelity: exact: the same numbers as there, 15 bits, from 0 on where nothing seeds them
//#   limit: all cogs share one row of numbers; there each has its own
//#   stack: 10 8
inline int32_t c_rand() {
  rand_state = rand_state * 1103515245UL + 12345;
  return rand_state >> 16 & 0x7FFF;
}
