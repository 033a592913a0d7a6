//# header propeller.h
// Counter, clock, pins and locks of the Propeller. Read from propgcc b280e7a77, lib/include/propeller1.h, propeller.h and cog.h.
// The counter is a virtual one of 80 MHz: micros() * 80 is continuous modulo 2^32, so that differences and targets mean what they meant.
// Bits of INA, OUTA and DIRA are ports of the source, and each is looked up.
//# task cognew it starts machine code of the Propeller, which no other microcontroller runs: write in C what that code does, and call it from loop, in steps that do not wait
//# task coginit it starts machine code of the Propeller, which no other microcontroller runs: write in C what that code does, and call it from loop, in steps that do not wait
//# task load_cog_driver it starts machine code of the Propeller, which no other microcontroller runs: write in C what that code does, and call it from loop, in steps that do not wait
//# task use_cog_driver it names machine code of the Propeller, which no other microcontroller runs: write what that code does in C
//# task get_cog_driver it names machine code of the Propeller, which no other microcontroller runs: write what that code does in C
//# task __builtin_propeller_coginit it starts machine code of the Propeller, which no other microcontroller runs: write in C what that code does, and call it from loop, in steps that do not wait
//# task clkset a mode with bit 7 (0x80) restarts the chip there: where that is meant, let the watchdog do it (on an AVR `wdt_enable(WDTO_15MS)` of avr/wdt.h and an endless loop, on a Pico `rp2040.reboot()`); any other mode sets a clock that this board does not change, and CLKFREQ stays that of the virtual counter, so that times stay right: take such a call out
//# task __builtin_propeller_clkset a mode with bit 7 (0x80) restarts the chip there: where that is meant, let the watchdog do it (on an AVR `wdt_enable(WDTO_15MS)` of avr/wdt.h and an endless loop, on a Pico `rp2040.reboot()`); any other mode sets a clock that this board does not change, and CLKFREQ stays that of the virtual counter, so that times stay right: take such a call out
//# task waitvid the video generator of the Propeller is hardware that this board has not: show what it shows on another display
//# task __builtin_propeller_waitvid the video generator of the Propeller is hardware that this board has not: show what it shows on another display

//# helper port
//#   table: port_pins 32
//#   fidelity: the pin of a port of the source; no pin when the port is not wired; what is negative stays
//#   ram: 32
inline int32_t port(int32_t number) {
  if (!__builtin_constant_p(number)) asm("" : "+r"(number));  // what has no value (1/0) is compared, too
  return number < 0 ? number : number < 32 ? port_pins[number] : 255;
}

//# helper ports
//#   needs: port
//#   fidelity: the pins of an array of ports of the source, as they are at the call; 32 at most
template <int place, class Number>
inline int32_t *ports(const Number *numbers, int32_t count) {
  static int32_t pins[32];
  for (uint8_t i = 0; i < count && i < 32; i++) pins[i] = port(numbers[i]);
  return pins;
}

//# constant CLKFREQ
//#   fidelity: exact; ticks of the virtual counter in a second, not the clock of the target
#define CLKFREQ 80000000L

//# constant _CLKFREQ
//#   fidelity: as CLKFREQ
#define _CLKFREQ 80000000L

//# variable _clkfreq
//#   needs: CLKFREQ
//#   fidelity: as CLKFREQ
//#   limit: a program that writes it changes nothing
//#   stack: 0
const uint32_t _clkfreq = CLKFREQ;

//# constant HUBDATA
//#   fidelity: says where data lie there, and nothing here
#define HUBDATA

//# constant HUBTEXT
//#   fidelity: says where code lies there, and nothing here
#define HUBTEXT

//# register CNT
//#   fidelity: exact on average; it moves in steps of 4 us (320 ticks)
//#   stack: 4
#define CNT ((uint32_t)micros() * 80UL)

//# register _CNT
//#   fidelity: as CNT
//#   stack: 4
#define _CNT ((uint32_t)micros() * 80UL)

//# helper wait_until
//#   needs: CNT
//#   fidelity: until a tick that is to come, within 8 us, later by what other cogs do until they wait
inline void wait_until(uint32_t target) {
  while ((int32_t)(CNT - target) < 0) yield();
}

//# adapter waitcnt
//#   for: unsigned int waitcnt(unsigned int target)
//#   kind: semantic
//#   needs: wait_until
//#   fidelity: within 8 us while no cogs take turns
//#   limit: where cogs take turns, it may end later: the others first run until they wait (see RS325)
//#   range: target none: it returns at once, but the original waits until the counter is there, up to 53.7 s; add CNT to wait from now
//#   limit: if the time is already past, it returns at once; the original waits until the counter comes round, up to 53.7 s
//#   stack: 4
inline uint32_t waitcnt(uint32_t target) {
  wait_until(target);
  return target;
}

//# adapter waitcnt2
//#   for: unsigned int waitcnt2(unsigned int target, unsigned int delta)
//#   kind: semantic
//#   needs: waitcnt
//#   fidelity: within 8 us while no cogs take turns; the next target is exact
//#   limit: where cogs take turns, it may end later: the others first run until they wait (see RS325)
//#   range: target none: it returns at once, but the original waits until the counter is there, up to 53.7 s; add CNT to wait from now
//#   limit: if the time is already past, it returns at once; the original waits until the counter comes round, up to 53.7 s
//#   stack: 4
inline uint32_t waitcnt2(uint32_t target, uint32_t delta) {
  return waitcnt(target) + delta;
}

//# helper read_ports
//#   needs: hal/Io port
//#   fidelity: a property of those ports whose bit is set in a mask
inline uint32_t read_ports(bool (*property)(const Io &), uint32_t mask) {
  uint32_t bits = 0;
  for (uint8_t first = 0; mask; first += 8, mask >>= 8) {
    uint8_t found = 0, bit = 1, number = first;
    for (uint8_t rest = mask; rest; rest >>= 1, bit <<= 1, number++)
      if (rest & 1 && property(Io(port(number)))) found |= bit;
    bits |= (uint32_t)found << first;
  }
  return bits;
}

//# register INA
//#   needs: hal/Io read_ports
//#   fidelity: levels at the pins; they are read one after the other, all in some 250 us; of `INA & mask` only
//#   fidelity: those of the mask, one in some 25 us
//#   stack: 14 0
const struct {
  static bool is_high(const Io &io) { return io.high(); }
  operator uint32_t() const { return read_ports(is_high, ~0UL); }
  void operator&() const = delete;  // what is behind a pointer would be this object, and no pin
  template <class Mask> uint32_t operator&(Mask mask) const { return read_ports(is_high, (uint32_t)mask); }
} INA = {};

//# register _INA
//#   needs: INA
//#   fidelity: as INA
//#   stack: 14 0
const auto &_INA = INA;

//# helper PortRegister
//#   needs: hal/Io hal/own_pins port read_ports
//#   fidelity: only the bits that change are written, so that pins that other functions drive stay as they are
struct PortRegister {
  bool directions;

  static bool is_output(const Io &io) { return owned(io); }
  static bool is_set(const Io &io) { return io.latch(); }
  uint32_t bits(uint32_t mask = ~0UL) const { return read_ports(directions ? is_output : is_set, mask); }
  operator uint32_t() const { return bits(); }
  void operator&() const = delete;  // what is behind a pointer would be this object, and no pin
  template <class Mask> uint32_t operator&(Mask mask) const { return bits((uint32_t)mask); }
  const PortRegister &change(uint32_t mask, uint32_t value, bool flips = false) const {
    bool all = mask == ~0UL;
    for (uint8_t first = 0; mask; first += 8, mask >>= 8, value >>= 8) {
      uint8_t number = first, levels = value;
      for (uint8_t rest = mask; rest; rest >>= 1, levels >>= 1, number++) {
        if (!(rest & 1)) continue;
        Io io(port(number));
        bool before = directions ? owned(io) : io.latch(), level = flips ? !before : levels & 1;
        if (level == before) continue;
        if (!directions && all && before && io.driven() && !owned(io)) continue;  // it rests since setup, or another cog drives it
        if (directions) io.drive(level);
        else io.set(level);
      }
    }
    return *this;
  }
  const PortRegister &operator=(uint32_t value) const { return change(~0UL, value); }
  const PortRegister &operator=(const PortRegister &other) const { return *this = other.bits(); }
  const PortRegister &operator|=(uint32_t mask) const { return change(mask, mask); }
  const PortRegister &operator&=(uint32_t mask) const { return change(~mask, 0); }
  const PortRegister &operator^=(uint32_t mask) const { return change(mask, 0, true); }
  const PortRegister &operator+=(uint32_t value) const { return *this = bits() + value; }
  const PortRegister &operator-=(uint32_t value) const { return *this = bits() - value; }
  const PortRegister &operator*=(uint32_t value) const { return *this = bits() * value; }
  const PortRegister &operator/=(uint32_t value) const { return *this = bits() / value; }
  const PortRegister &operator%=(uint32_t value) const { return *this = bits() % value; }
  const PortRegister &operator<<=(uint8_t count) const { return *this = bits() << count; }
  const PortRegister &operator>>=(uint8_t count) const { return *this = bits() >> count; }
  const PortRegister &operator++() const { return *this += 1; }
  const PortRegister &operator--() const { return *this -= 1; }
  uint32_t operator++(int) const {
    uint32_t before = bits();
    *this = before + 1;
    return before;
  }
  uint32_t operator--(int) const {
    uint32_t before = bits();
    *this = before - 1;
    return before;
  }
};

//# register OUTA
//#   needs: PortRegister
//#   fidelity: the output latches of the whole program; on the Propeller each cog has its own. Bits change one after the other:
//#   fidelity: all in some 280 us, one with |=, &= or ^= in some 40 us
//#   limit: ports that are not wired keep no bit: 0 is read
//#   stack: 32 18
const PortRegister OUTA = {false};

//# register DIRA
//#   needs: PortRegister
//#   fidelity: the directions of the cog that runs, as there; where the target has no cogs, of the whole program. Bits change
//#   fidelity: one after the other: all in some 280 us, one with |=, &= or ^= in some 40 us
//#   limit: ports that are not wired keep no bit: 0 is read
//#   stack: 32 18
const PortRegister DIRA = {true};

//# register _OUTA
//#   needs: PortRegister OUTA
//#   fidelity: as OUTA
//#   stack: 32 18
static const PortRegister &_OUTA = OUTA;

//# register _DIRA
//#   needs: PortRegister DIRA
//#   fidelity: as DIRA
//#   stack: 32 18
static const PortRegister &_DIRA = DIRA;

//# adapter waitpeq
//#   for: void waitpeq(unsigned int state, unsigned int mask)
//#   kind: semantic
//#   needs: INA
//#   fidelity: within 40 us for one port, 10 us more for each further one
//#   limit: a state that lasts less than that can be missed
//#   stack: 13 6
inline void waitpeq(uint32_t state, uint32_t mask) {
  while ((INA & mask) != state) yield();
}

//# adapter waitpne
//#   for: void waitpne(unsigned int state, unsigned int mask)
//#   kind: semantic
//#   needs: INA
//#   fidelity: within 40 us for one port, 10 us more for each further one
//#   limit: a state that lasts less than that can be missed
//#   stack: 13 6
inline void waitpne(uint32_t state, uint32_t mask) {
  while ((INA & mask) == state) yield();
}

//# adapter getcnt
//#   for: unsigned int getcnt()
//#   kind: oneToOne
//#   needs: CNT
//#   fidelity: as CNT
//#   stack: 2 0
inline uint32_t getcnt() {
  return CNT;
}

//# adapter getpin
//#   for: int getpin(int pin)
//#   kind: oneToMany
//#   needs: hal/Io hal/KnownIo
//#   pin: pin digital in
//#   fidelity: exact: the output latch is cleared and the direction stays, as there
//#   stack: 4 0
inline int32_t getpin_at(int32_t pin) {
  Io io(pin);
  io.set(false);
  return io.high();
}

__attribute__((always_inline)) inline int32_t getpin(int32_t pin) {
  if (!pin_is_known(pin)) return getpin_at(pin);
  KnownIo io(pin);
  io.set(false);
  return io.high();
}

//# adapter setpin
//#   for: void setpin(int pin, int value)
//#   kind: oneToMany
//#   needs: simpletools.h/drive_level hal/KnownIo
//#   pin: pin digital out
//#   fidelity: exact
//#   stack: 12 2
__attribute__((always_inline)) inline void setpin(int32_t pin, int32_t value) {
  if (pin_is_known(pin)) KnownIo(pin).level(value != 0);
  else drive_level(pin, value != 0);
}

//# adapter togglepin
//#   for: void togglepin(int pin)
//#   kind: oneToMany
//#   needs: hal/Io hal/KnownIo
//#   pin: pin digital out
//#   fidelity: exact: the latch is inverted and the pin becomes an output
//#   stack: 4 0
inline void togglepin_at(int32_t pin) {
  Io io(pin);
  io.set(!io.latch());
  io.drive(true);
}

__attribute__((always_inline)) inline void togglepin(int32_t pin) {
  if (!pin_is_known(pin)) return togglepin_at(pin);
  KnownIo io(pin);
  io.set(!io.latch());
  io.drive(true);
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
//#   stack: 2 0
inline int32_t locknew() {
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
//#   stack: 0
inline void lockret(int32_t lockid) {
  locks_given &= ~(1 << (lockid & 7));
}

//# adapter lockset
//#   for: int lockset(int lockid)
//#   kind: semantic
//#   needs: locks_set
//#   fidelity: exact: -1 when the lock was set already, else 0
//#   stack: 0
inline int32_t lockset(int32_t lockid) {
  bool before = locks_set >> (lockid & 7) & 1;
  locks_set |= 1 << (lockid & 7);
  return -(int32_t)before;
}

//# adapter lockclr
//#   for: int lockclr(int lockid)
//#   kind: semantic
//#   needs: locks_set
//#   fidelity: exact: -1 when the lock was set, else 0
//#   stack: 2 0
inline int32_t lockclr(int32_t lockid) {
  bool before = locks_set >> (lockid & 7) & 1;
  locks_set &= ~(1 << (lockid & 7));
  return -(int32_t)before;
}

//# helper COG_SLOTS
//#   fidelity: how many cogs run beside main at once, and how many bytes the stack of each has: the plan of a migration says
#ifndef COG_SLOTS
#define COG_SLOTS 1
#define COG_STACK 200
#endif

//# helper cog_table
//#   needs: COG_SLOTS hal/cog_frame
//#   fidelity: code of other cogs runs on stacks of its own; one cog runs at a time, until it waits or ends
//#   limit: a stack holds COG_STACK bytes: locals and calls of the cog, and the interrupts that come meanwhile
//#   ram: 13
enum { COG_PAINT = 0xA5 };  // what an unused stack is filled with

struct CogTable {
  uint8_t stack[COG_SLOTS][COG_STACK + cog_room];  // in front: what runs over leaves the rest as it is
  uint8_t now;
  uint8_t *saved[COG_SLOTS + 1];  // the stack pointer of each that waits
  void (*code[COG_SLOTS + 1])(void *);
  void *parameter[COG_SLOTS + 1];
};
static CogTable cog_table;

//# helper cogs_running
//#   fidelity: bit n: cog n runs; 0 is main
//#   ram: 1
static uint8_t cogs_running = 1;

//# helper held_up
//#   fidelity: by how many microseconds others made waits of the cog that runs longer, and none was made shorter for it yet
//#   ram: 4
static uint32_t held_up = 0;

//# helper cog_pins
//#   needs: COG_SLOTS hal/Io
//#   fidelity: which pins each cog drives, main from the start; the level at which a part does nothing is nobody's
//#   ram: 6
static uint8_t cog_pins[COG_SLOTS + 1][(NUM_DIGITAL_PINS + 7) / 8];

struct CogPins {
  CogPins() { cog_pins_now = cog_pins[0]; }
};
static CogPins cog_pins_begun;

//# helper yield
//#   needs: COG_SLOTS cog_pins hal/Io cog_table cogs_running held_up hal/cog_switch hal/cog_overflow hal/cog_heap hal/cog_frame hal/stack_pointer
//#   fidelity: the next cog that runs goes on; all that waits on the target calls this
//#   stack: 65
extern "C" inline __attribute__((used)) void yield() {
  uint8_t from = cog_table.now, to = from;
  if (from) {
    const uint8_t *stack = cog_table.stack[from - 1];
    if (*stack != COG_PAINT || stack_pointer() < stack + cog_saved + 8) cog_overflow(from);
  }
  do to = to < COG_SLOTS ? to + 1 : 0;
  while (to != from && !(cogs_running >> to & 1));
  if (to == from) return;
  cog_table.now = to;
  cog_pins_now = cog_pins[to];
  cog_heap(!from, !to);
  uint32_t mine = held_up;
  cog_switch(&cog_table.saved[from], cog_table.saved[to]);
  asm volatile("" : "+m"(held_up));  // others wrote it meanwhile
  held_up = mine;
}

//# helper cog_release
//#   needs: COG_SLOTS cog_pins hal/Io
//#   fidelity: pins that only this cog drove become inputs; a pin that another cog drives, too, keeps its level
inline void cog_release(uint8_t number) {
  for (uint8_t pin = 0; pin < NUM_DIGITAL_PINS; pin++) {
    uint8_t at = pin >> 3, bit = 1 << (pin & 7), others = 0;
    if (!(cog_pins[number][at] & bit)) continue;
    cog_pins[number][at] &= ~bit;
    for (uint8_t cog = 0; cog <= COG_SLOTS; cog++) others |= cog_pins[cog][at] & bit;
    if (others) continue;
    Io io(pin);
    io.drive(false);
    io.set(false);
  }
}

//# helper cog_stop
//#   needs: cog_table cogs_running yield cog_release COG_SLOTS
//#   fidelity: a cog that stops itself does not come back
inline void cog_stop(int32_t number) {
  if (number < 0 || number > COG_SLOTS) return;
  cogs_running &= ~(1 << number);
  cog_release(number);
  while (!(cogs_running >> cog_table.now & 1)) yield();
}

//# helper cog_main
//#   needs: cog_table cog_stop held_up
//#   fidelity: a cog stops when its function ends
inline void cog_main() {
  uint8_t number = cog_table.now;
  held_up = 0;
  cog_table.code[number](cog_table.parameter[number]);
  cog_stop(number);
}

//# helper cog_begin
//#   needs: cog_table cogs_running cog_main COG_SLOTS hal/cog_frame
//#   fidelity: false where the cog runs already; its function begins when the starter waits
inline bool cog_begin(uint8_t number, void (*code)(void *), void *parameter) {
  if (cogs_running >> number & 1 || number == cog_table.now) return false;
  uint8_t *stack = cog_table.stack[number - 1];
  memset(stack, COG_PAINT, COG_STACK + cog_room);
  cog_table.saved[number] = cog_frame(stack + COG_STACK + cog_room, cog_main);
  cog_table.code[number] = code;
  cog_table.parameter[number] = parameter;
  cogs_running |= 1 << number;
  return true;
}

//# helper cog_start
//#   needs: COG_SLOTS cog_begin
//#   fidelity: the number of the cog, -1 when none is free
inline int8_t cog_start(void (*code)(void *), void *parameter) {
  for (uint8_t number = 1; number <= COG_SLOTS; number++) {
    if (cog_begin(number, code, parameter)) return number;
  }
  return -1;
}

//# helper cog_stack_used
//#   needs: cog_table COG_SLOTS hal/cog_frame
//#   fidelity: the most bytes that a cog had on its stack since it was started
inline uint16_t cog_stack_used(uint8_t number) {
  const uint8_t *stack = cog_table.stack[number - 1];
  uint16_t unused = 0;
  while (unused < COG_STACK + cog_room && stack[unused] == COG_PAINT) unused++;
  return COG_STACK + cog_room - unused;
}

//# adapter cogstart
//#   for: int cogstart(void (*func)(void *), void *par, void *stack, size_t stacksize)
//#   kind: semantic
//#   needs: cog_start
//#   fidelity: the number of the cog, -1 when none is free; it runs whenever the others wait
//#   limit: the memory given is not used: each cog has a stack of COG_STACK bytes of its own
//#   stack: 14 2
inline int32_t cogstart(void (*func)(void *), void *par, void *stack, uint32_t stacksize) {
  (void)stack;
  (void)stacksize;
  return cog_start(func, par);
}

//# adapter cogid
//#   for: int cogid(void)
//#   kind: semantic
//#   needs: cog_table
//#   fidelity: exact; 0 is the cog of main
//#   stack: 0
inline int32_t cogid() {
  return cog_table.now;
}

//# adapter cogstop
//#   for: void cogstop(int cogid)
//#   kind: semantic
//#   needs: cog_stop
//#   fidelity: exact
//#   stack: 75 65
inline void cogstop(int32_t cogid) {
  cog_stop(cogid);
}

// ---------------------------------------------------------------- what the macros of propeller.h stand for

//# adapter __builtin_propeller_waitcnt
//#   for: unsigned int __builtin_propeller_waitcnt(unsigned int target, unsigned int delta)
//#   kind: oneToOne
//#   needs: waitcnt2
//#   fidelity: within 8 us; the next target is exact
//#   range: target none: it returns at once, but the original waits until the counter is there, up to 53.7 s; add CNT to wait from now
//#   limit: if the time is already past, it returns at once; the original waits until the counter comes round, up to 53.7 s
//#   stack: 4
inline uint32_t __builtin_propeller_waitcnt(uint32_t target, uint32_t delta) {
  return waitcnt2(target, delta);
}

//# adapter __builtin_propeller_waitpeq
//#   for: void __builtin_propeller_waitpeq(unsigned int state, unsigned int mask)
//#   kind: oneToOne
//#   needs: waitpeq
//#   fidelity: as waitpeq
//#   limit: a state that lasts less than 200 us can be missed
//#   stack: 13 6
inline void __builtin_propeller_waitpeq(uint32_t state, uint32_t mask) {
  waitpeq(state, mask);
}

//# adapter __builtin_propeller_waitpne
//#   for: void __builtin_propeller_waitpne(unsigned int state, unsigned int mask)
//#   kind: oneToOne
//#   needs: waitpne
//#   fidelity: as waitpne
//#   limit: a state that lasts less than 200 us can be missed
//#   stack: 13 6
inline void __builtin_propeller_waitpne(uint32_t state, uint32_t mask) {
  waitpne(state, mask);
}

//# adapter __builtin_propeller_locknew
//#   for: int __builtin_propeller_locknew(void)
//#   kind: oneToOne
//#   needs: locknew
//#   fidelity: exact: the number of a lock, -1 when all eight are given out
//#   stack: 2 0
inline int32_t __builtin_propeller_locknew() {
  return locknew();
}

//# adapter __builtin_propeller_lockret
//#   for: void __builtin_propeller_lockret(int lockid)
//#   kind: oneToOne
//#   needs: lockret
//#   fidelity: exact
//#   stack: 0
inline void __builtin_propeller_lockret(int32_t lockid) {
  lockret(lockid);
}

//# adapter __builtin_propeller_lockset
//#   for: int __builtin_propeller_lockset(int lockid)
//#   kind: oneToOne
//#   needs: lockset
//#   fidelity: exact: -1 when the lock was set already, else 0
//#   stack: 0
inline int32_t __builtin_propeller_lockset(int32_t lockid) {
  return lockset(lockid);
}

//# adapter __builtin_propeller_lockclr
//#   for: int __builtin_propeller_lockclr(int lockid)
//#   kind: oneToOne
//#   needs: lockclr
//#   fidelity: exact: -1 when the lock was set, else 0
//#   stack: 0
inline int32_t __builtin_propeller_lockclr(int32_t lockid) {
  return lockclr(lockid);
}

//# adapter __builtin_propeller_rev
//#   for: int __builtin_propeller_rev(int value, int cleared)
//#   kind: oneToMany
//#   fidelity: the lower 32 less `cleared` bits the other way round, the others 0; five bits of `cleared` count, as in the instruction
//#   stack: 0
inline int32_t __builtin_propeller_rev(int32_t value, int32_t cleared) {
  uint32_t left = value, turned = 0;
  for (uint8_t bits = 32 - (cleared & 31); bits > 0; bits--) {
    turned = turned << 1 | (left & 1);
    left >>= 1;
  }
  return turned;
}

//# adapter __builtin_propeller_cogid
//#   for: int __builtin_propeller_cogid(void)
//#   kind: oneToOne
//#   needs: cogid
//#   fidelity: exact; 0 is the cog of main
//#   stack: 0
inline int32_t __builtin_propeller_cogid() {
  return cogid();
}

//# adapter __builtin_propeller_cogstop
//#   for: void __builtin_propeller_cogstop(int cogid)
//#   kind: oneToOne
//#   needs: cogstop
//#   fidelity: exact
//#   stack: 75 65
inline void __builtin_propeller_cogstop(int32_t cogid) {
  cogstop(cogid);
}
