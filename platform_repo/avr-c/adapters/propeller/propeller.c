//# header propeller.h
// Counter, clock and locks of the Propeller in C. Read from propgcc b280e7a77, lib/include/propeller1.h, propeller.h and cog.h.
// The counter is a virtual one of 80 MHz: clock_us() * 80 is continuous modulo 2^32. A pin is AVR_PIN(port, bit), any other number none.

//# helper clock_us
//#   include: <avr/interrupt.h>
//#   timer: Timer0
//#   vector: TIMER0_OVF_vect
//#   fidelity: microseconds since the program began, in steps of 64 cycles (4 us at 16 MHz)
//#   ram: 4
static volatile uint32_t clock_rounds;

ISR(TIMER0_OVF_vect) {
  clock_rounds++;
}

__attribute__((constructor, used)) static void clock_start(void) {
  TCCR0B = _BV(CS01) | _BV(CS00);
  TIMSK0 |= _BV(TOIE0);
  sei();
}

static inline uint32_t clock_us(void) {
  uint8_t old = SREG;
  cli();
  uint32_t rounds = clock_rounds;
  uint8_t part = TCNT0;
  if (TIFR0 & _BV(TOV0) && part < 255) rounds++;
  SREG = old;
  return (rounds << 8 | part) * (uint32_t)(64 / (F_CPU / 1000000UL));
}

//# helper clock_wait
//#   needs: clock_us
//#   fidelity: so many milliseconds
static inline void clock_wait(uint32_t milliseconds) {
  for (uint32_t begun = clock_us(); milliseconds; milliseconds--, begun += 1000)
    while (clock_us() - begun < 1000) {}
}

//# helper port
//#   table: port_pins 32
//#   fidelity: the pin of a port of the source; no pin when the port is not wired; what is negative stays
//#   ram: 32
static inline int32_t port(int32_t number) {
  return number < 0 ? number : number < 32 ? port_pins[number] : 255;
}

//# constant CLKFREQ
//#   fidelity: exact; ticks of the virtual counter in a second, not the clock of the target
#define CLKFREQ 80000000L

//# constant _CLKFREQ
//#   fidelity: as CLKFREQ
#define _CLKFREQ 80000000L

//# constant HUBDATA
//#   fidelity: says where data lie there, and nothing here
#define HUBDATA

//# constant HUBTEXT
//#   fidelity: says where code lies there, and nothing here
#define HUBTEXT

//# register CNT
//#   needs: clock_us
//#   fidelity: exact on average; it moves in steps of 4 us (320 ticks)
#define CNT (clock_us() * 80UL)

//# helper wait_until
//#   needs: CNT
//#   fidelity: until a tick that is to come, within 8 us
static inline void wait_until(uint32_t target) {
  while ((int32_t)(CNT - target) < 0) {}
}

//# adapter waitcnt
//#   for: unsigned int waitcnt(unsigned int target)
//#   kind: semantic
//#   needs: wait_until
//#   fidelity: within 8 us
//#   limit: a target that is already past returns at once; there it waits until the counter comes round, up to 53.7 s
static inline uint32_t waitcnt(uint32_t target) {
  wait_until(target);
  return target;
}

//# adapter waitcnt2
//#   for: unsigned int waitcnt2(unsigned int target, unsigned int delta)
//#   kind: semantic
//#   needs: waitcnt
//#   fidelity: within 8 us; the next target is exact
//#   limit: a target that is already past returns at once; there it waits until the counter comes round, up to 53.7 s
static inline uint32_t waitcnt2(uint32_t target, uint32_t delta) {
  return waitcnt(target) + delta;
}

//# register INA
//#   needs: simpletools.h/Io port
//#   fidelity: levels at the pins; they are read one after the other, in some 100 us
static inline uint32_t port_levels(void) {
  uint32_t bits = 0;
  for (int8_t number = 31; number >= 0; number--) bits = bits << 1 | io_high(io_at(port(number)));
  return bits;
}
#define INA port_levels()

//# adapter waitpeq
//#   for: void waitpeq(unsigned int state, unsigned int mask)
//#   kind: semantic
//#   needs: INA
//#   fidelity: within 200 us
//#   limit: a state that lasts less than 200 us can be missed
static inline void waitpeq(uint32_t state, uint32_t mask) {
  while ((INA & mask) != state) {}
}

//# adapter waitpne
//#   for: void waitpne(unsigned int state, unsigned int mask)
//#   kind: semantic
//#   needs: INA
//#   fidelity: within 200 us
//#   limit: a state that lasts less than 200 us can be missed
static inline void waitpne(uint32_t state, uint32_t mask) {
  while ((INA & mask) == state) {}
}

//# helper locks_given
//#   fidelity: which of the eight locks are given out
//#   ram: 1
static uint8_t locks_given = 0;

//# helper locks_set
//#   fidelity: which of the eight locks are set
//#   ram: 1
static uint8_t locks_set = 0;

//# adapter locknew
//#   for: int locknew(void)
//#   kind: semantic
//#   needs: locks_given
//#   fidelity: exact: the number of a lock, -1 when all eight are given out
static inline int32_t locknew(void) {
  for (uint8_t number = 0; number < 8; number++) {
    if (locks_given >> number & 1) continue;
    locks_given |= 1 << number;
    return number;
  }
  return -1;
}

//# adapter lockret
//#   for: void lockret(int lockid)
//#   kind: semantic
//#   needs: locks_given
//#   fidelity: exact
static inline void lockret(int32_t lockid) {
  locks_given &= ~(1 << (lockid & 7));
}

//# adapter lockset
//#   for: int lockset(int lockid)
//#   kind: semantic
//#   needs: locks_set
//#   fidelity: exact: -1 when the lock was set already, else 0
static inline int32_t lockset(int32_t lockid) {
  bool before = locks_set >> (lockid & 7) & 1;
  locks_set |= 1 << (lockid & 7);
  return -(int32_t)before;
}

//# adapter lockclr
//#   for: int lockclr(int lockid)
//#   kind: semantic
//#   needs: locks_set
//#   fidelity: exact: -1 when the lock was set, else 0
static inline int32_t lockclr(int32_t lockid) {
  bool before = locks_set >> (lockid & 7) & 1;
  locks_set &= ~(1 << (lockid & 7));
  return -(int32_t)before;
}
