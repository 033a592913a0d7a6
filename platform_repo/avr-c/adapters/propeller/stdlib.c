//# header stdlib.h
// Random numbers. Read from propgcc b280e7a77, lib/include/stdlib.h and lib/stdlib/rand.c. All else of the header is that of avr-libc.

//# helper rand_state
//#   ram: 4
static uint32_t rand_state = 0;

//# adapter srand
//#   for: void srand(unsigned int seed)
//#   kind: oneToOne
//#   name: c_srand
//#   needs: rand_state
//#   fidelity: exact
static inline void c_srand(uint32_t seed) {
  rand_state = seed;
}

//# adapter rand
//#   for: int rand(void)
//#   kind: oneToOne
//#   name: c_rand
//#   needs: rand_state
//#   fidelity: exact: the same numbers as there, 15 bits, from 0 on where nothing seeds them
static inline int32_t c_rand(void) {
  rand_state = rand_state * 1103515245UL + 12345;
  return rand_state >> 16 & 0x7FFF;
}
