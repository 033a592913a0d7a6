//# header propeller.h
// Counter, clock and locks of the Propeller in C. Read from propgcc b280e7a77, lib/include/propeller1.h, propeller.h and cog.h.
// The counter is a virtual one of 80 MHz: clock_us() * 80 is continuous modulo 2^32. A pin is AVR_PIN(port, bit), any other number none.
//# task cognew it starts machine code of the Propeller, which no other microcontroller runs: write what that code does in C, and call it where it is to run
//# task coginit it starts machine code of the Propeller, which no other microcontroller runs: write what that code does in C, and call it where it is to run
//# task load_cog_driver it starts machine code of the Propeller, which no other microcontroller runs: write what that code does in C, and call it where it is to run
//# task use_cog_driver it names machine code of the Propeller, which no other microcontroller runs: write what that code does in C
//# task get_cog_driver it names machine code of the Propeller, which no other microcontroller runs: write what that code does in C
//# task __builtin_propeller_coginit it starts machine code of the Propeller, which no other microcontroller runs: write what that code does in C, and call it where it is to run
//# task clkset a mode with bit 7 (0x80) restarts the chip there: where that is meant, let the watchdog do it (`wdt_enable(WDTO_15MS)` of avr/wdt.h, then an endless loop); any other mode sets a clock that this board does not change, and CLKFREQ stays that of the virtual counter, so that times stay right: take such a call out
//# task __builtin_propeller_clkset a mode with bit 7 (0x80) restarts the chip there: where that is meant, let the watchdog do it (`wdt_enable(WDTO_15MS)` of avr/wdt.h, then an endless loop); any other mode sets a clock that this board does not change, and CLKFREQ stays that of the virtual counter, so that times stay right: take such a call out
//# task waitvid the video generator of the Propeller is hardware that this board has not: show what it shows on another display
//# task __builtin_propeller_waitvid the video generator of the Propeller is hardware that this board has not: show what it shows on another display

//# helper register_job
//#   fidelity: what keeps the pins in step with OUTA and DIRA, where a program has these
//#   ram: 2
static void (*register_job)(void);

//# helper clock_us
//#   needs: register_job
//#   include: <avr/interrupt.h>
//#   timer: Timer0
//#   vector: TIMER0_OVF_vect
//#   fidelity: microseconds since the program began, in steps of 64 cycles (4 us at 16 MHz)
//#   ram: 4
static volatile uint32_t clock_rounds;

ISR(TIMER0_OVF_vect) {
  clock_rounds++;
  if (register_job) register_job();
}

__attribute__((constructor, used)) static void clock_start(void) {
  TCCR0B = _BV(CS01) | _BV(CS00);
  TIMSK0 |= _BV(TOIE0);
  sei();
}

static inline uint32_t clock_us(void) {
  if (register_job) register_job();
  uint8_t old = SREG;
  cli();
  uint32_t rounds = clock_rounds;
  uint8_t part = TCNT0;
  if (TIFR0 & _BV(TOV0) && part < 255) rounds++;
  SREG = old;
  return (rounds << 8 | part) * (uint32_t)(64 / (F_CPU / 1000000UL));
}

//# helper clock_ms
//#   needs: clock_us
//#   include: <avr/interrupt.h>
//#   fidelity: milliseconds since the program began, for 49 days; up to 2 ms late
static inline uint32_t clock_ms(void) {
  const uint8_t part = 16000000UL / F_CPU;  // 1,024 us each round at 16 MHz
  uint8_t old = SREG;
  cli();
  uint32_t rounds = clock_rounds;
  SREG = old;
  return rounds * part + rounds / 125 * (3 * part) + rounds % 125 * (3 * part) / 125;
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
  if (!__builtin_constant_p(number)) asm("" : "+r"(number));  // what has no value (1/0) is compared, too
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
//#   range: target none: it returns at once, but the original waits until the counter is there, up to 53.7 s; add CNT to wait from now
//#   limit: if the time is already past, it returns at once; the original waits until the counter comes round, up to 53.7 s
static inline uint32_t waitcnt(uint32_t target) {
  wait_until(target);
  return target;
}

//# adapter waitcnt2
//#   for: unsigned int waitcnt2(unsigned int target, unsigned int delta)
//#   kind: semantic
//#   needs: waitcnt
//#   fidelity: within 8 us; the next target is exact
//#   range: target none: it returns at once, but the original waits until the counter is there, up to 53.7 s; add CNT to wait from now
//#   limit: if the time is already past, it returns at once; the original waits until the counter comes round, up to 53.7 s
static inline uint32_t waitcnt2(uint32_t target, uint32_t delta) {
  return waitcnt(target) + delta;
}

//# register INA
//#   needs: simpletools.h/Io port register_job
//#   fidelity: levels at the pins; they are read one after the other, in some 100 us
static inline uint32_t port_levels(void) {
  uint32_t bits = 0;
  if (register_job) register_job();
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

//# helper PortBits
//#   needs: simpletools.h/Io port register_job clock_us
//#   fidelity: a program writes what it asks for as a number; bits that were changed reach their pins when the next register, the counter or
//#   fidelity: the levels are asked for, at the latest with the next overflow of Timer0
//#   ram: 16
typedef struct {
  volatile uint32_t asked;
  uint32_t done;
} PortBits;
static PortBits out_bits, direction_bits;

static void put_port_bits(PortBits *bits, bool directions) {
  uint32_t asked = bits->asked, changed = asked ^ bits->done;
  bits->done = asked;
  for (uint8_t number = 0; changed; number++, changed >>= 1) {
    if (!(changed & 1)) continue;
    Io io = io_at(port(number));
    if (directions) io_drive(io, asked >> number & 1);
    else io_set(io, asked >> number & 1);
  }
}

static void put_registers(void) {
  uint8_t old = SREG;
  cli();
  put_port_bits(&out_bits, false);
  put_port_bits(&direction_bits, true);
  SREG = old;
}

static inline volatile uint32_t *port_bits(PortBits *bits, bool directions) {
  uint32_t now = 0;
  put_registers();
  for (int8_t number = 31; number >= 0; number--) {
    Io io = io_at(port(number));
    now = now << 1 | (directions ? io_owned(io) : io_latch(io));
  }
  uint8_t old = SREG;
  cli();
  bits->asked = bits->done = now;
  register_job = put_registers;
  SREG = old;
  clock_us();
  return &bits->asked;
}

//# register OUTA
//#   needs: PortBits
//#   fidelity: the output latches of the whole program; on the Propeller each cog has its own. Bits change one after the other, in some 100 us
//#   limit: a change reaches the pins with the next use of a register, the counter or a wait, and 1 ms later at the latest
//#   limit: ports that are not wired keep no bit: 0 is read
#define OUTA (*port_bits(&out_bits, false))

//# register DIRA
//#   needs: PortBits
//#   fidelity: the directions of the whole program; on the Propeller each cog has its own. Bits change one after the other, in some 100 us
//#   limit: a change reaches the pins with the next use of a register, the counter or a wait, and 1 ms later at the latest
//#   limit: ports that are not wired keep no bit: 0 is read
#define DIRA (*port_bits(&direction_bits, true))

//# register _OUTA
//#   needs: OUTA
//#   fidelity: as OUTA
#define _OUTA OUTA

//# register _DIRA
//#   needs: DIRA
//#   fidelity: as DIRA
#define _DIRA DIRA

//# register _INA
//#   needs: INA
//#   fidelity: as INA
#define _INA INA

//# register _CNT
//#   needs: CNT
//#   fidelity: as CNT
#define _CNT CNT

//# variable _clkfreq
//#   needs: CLKFREQ
//#   fidelity: as CLKFREQ
//#   limit: a program that writes it changes nothing
#define _clkfreq ((uint32_t)CLKFREQ)

//# adapter getcnt
//#   for: unsigned int getcnt()
//#   kind: oneToOne
//#   needs: CNT
//#   fidelity: as CNT
static inline uint32_t getcnt(void) {
  return CNT;
}

//# adapter getpin
//#   for: int getpin(int pin)
//#   kind: oneToMany
//#   needs: simpletools.h/Io
//#   pin: pin digital in
//#   fidelity: exact: the output latch is cleared and the direction stays, as there
static inline int32_t getpin(int32_t pin) {
  Io io = io_at(pin);
  io_set(io, false);
  return io_high(io);
}

//# adapter setpin
//#   for: void setpin(int pin, int value)
//#   kind: oneToMany
//#   needs: simpletools.h/Io
//#   pin: pin digital out
//#   fidelity: exact
static inline void setpin(int32_t pin, int32_t value) {
  Io io = io_at(pin);
  io_set(io, value != 0);
  io_drive(io, true);
}

//# adapter togglepin
//#   for: void togglepin(int pin)
//#   kind: oneToMany
//#   needs: simpletools.h/Io
//#   pin: pin digital out
//#   fidelity: exact: the latch is inverted and the pin becomes an output
static inline void togglepin(int32_t pin) {
  Io io = io_at(pin);
  io_set(io, !io_latch(io));
  io_drive(io, true);
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

// ---------------------------------------------------------------- what the macros of propeller.h stand for

//# adapter __builtin_propeller_waitcnt
//#   for: unsigned int __builtin_propeller_waitcnt(unsigned int target, unsigned int delta)
//#   kind: oneToOne
//#   needs: waitcnt2
//#   fidelity: within 8 us; the next target is exact
//#   range: target none: it returns at once, but the original waits until the counter is there, up to 53.7 s; add CNT to wait from now
//#   limit: if the time is already past, it returns at once; the original waits until the counter comes round, up to 53.7 s
static inline uint32_t __builtin_propeller_waitcnt(uint32_t target, uint32_t delta) {
  return waitcnt2(target, delta);
}

//# adapter __builtin_propeller_waitpeq
//#   for: void __builtin_propeller_waitpeq(unsigned int state, unsigned int mask)
//#   kind: oneToOne
//#   needs: waitpeq
//#   fidelity: as waitpeq
//#   limit: a state that lasts less than 200 us can be missed
static inline void __builtin_propeller_waitpeq(uint32_t state, uint32_t mask) {
  waitpeq(state, mask);
}

//# adapter __builtin_propeller_waitpne
//#   for: void __builtin_propeller_waitpne(unsigned int state, unsigned int mask)
//#   kind: oneToOne
//#   needs: waitpne
//#   fidelity: as waitpne
//#   limit: a state that lasts less than 200 us can be missed
static inline void __builtin_propeller_waitpne(uint32_t state, uint32_t mask) {
  waitpne(state, mask);
}

//# adapter __builtin_propeller_locknew
//#   for: int __builtin_propeller_locknew(void)
//#   kind: oneToOne
//#   needs: locknew
//#   fidelity: exact: the number of a lock, -1 when all eight are given out
static inline int32_t __builtin_propeller_locknew(void) {
  return locknew();
}

//# adapter __builtin_propeller_lockret
//#   for: void __builtin_propeller_lockret(int lockid)
//#   kind: oneToOne
//#   needs: lockret
//#   fidelity: exact
static inline void __builtin_propeller_lockret(int32_t lockid) {
  lockret(lockid);
}

//# adapter __builtin_propeller_lockset
//#   for: int __builtin_propeller_lockset(int lockid)
//#   kind: oneToOne
//#   needs: lockset
//#   fidelity: exact: -1 when the lock was set already, else 0
static inline int32_t __builtin_propeller_lockset(int32_t lockid) {
  return lockset(lockid);
}

//# adapter __builtin_propeller_lockclr
//#   for: int __builtin_propeller_lockclr(int lockid)
//#   kind: oneToOne
//#   needs: lockclr
//#   fidelity: exact: -1 when the lock was set, else 0
static inline int32_t __builtin_propeller_lockclr(int32_t lockid) {
  return lockclr(lockid);
}
