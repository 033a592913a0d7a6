//# header propeller.h
// The system counter and the clock of the Propeller, and waiting for them. Read from propgcc b280e7a77, lib/include/propeller1.h and cog.h.
// The counter is a virtual one of 80 MHz: micros() * 80 is continuous modulo 2^32, so that differences and targets mean what they meant.

//# constant CLKFREQ
//#   fidelity: exact; ticks of the virtual counter in a second, not the clock of the target
#define CLKFREQ 80000000L

//# register CNT
//#   fidelity: exact on average; it moves in steps of 4 us (320 ticks)
#define CNT ((uint32_t)micros() * 80UL)

//# adapter waitcnt
//#   for: void waitcnt(unsigned int target)
//#   kind: semantic
//#   needs: CNT
//#   fidelity: within 8 us
//#   limit: a target that is already past returns at once; there it waits until the counter comes round, up to 53.7 s
inline void waitcnt(uint32_t target) {
  while ((int32_t)(CNT - target) < 0) yield();
}
