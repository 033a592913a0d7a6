//# header propeller.h
// Counter, clock, pins and locks of the Propeller. Read from propgcc b280e7a77, lib/include/propeller1.h, propeller.h and cog.h.
// The counter is a virtual one of 80 MHz: micros() * 80 is continuous modulo 2^32, so that differences and targets mean what they meant.
// Bits of INA, OUTA and DIRA are ports of the source, and each is looked up.

//# helper port
//#   table: port_pins 32
//#   fidelity: the pin of a port of the source; no pin when the port is not wired
inline int32_t port(int32_t number) {
  return number >= 0 && number < 32 ? port_pins[number] : 255;
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
const uint32_t _clkfreq = CLKFREQ;

//# constant HUBDATA
//#   fidelity: says where data lie there, and nothing here
#define HUBDATA

//# constant HUBTEXT
//#   fidelity: says where code lies there, and nothing here
#define HUBTEXT

//# register CNT
//#   fidelity: exact on average; it moves in steps of 4 us (320 ticks)
#define CNT ((uint32_t)micros() * 80UL)

//# register _CNT
//#   fidelity: as CNT
#define _CNT ((uint32_t)micros() * 80UL)

//# adapter waitcnt
//#   for: unsigned int waitcnt(unsigned int target)
//#   kind: semantic
//#   needs: CNT
//#   fidelity: within 8 us
//#   limit: a target that is already past returns at once; there it waits until the counter comes round, up to 53.7 s
inline uint32_t waitcnt(uint32_t target) {
  while ((int32_t)(CNT - target) < 0) yield();
  return target;
}

//# adapter waitcnt2
//#   for: unsigned int waitcnt2(unsigned int target, unsigned int delta)
//#   kind: semantic
//#   needs: waitcnt
//#   fidelity: within 8 us; the next target is exact
//#   limit: a target that is already past returns at once; there it waits until the counter comes round, up to 53.7 s
inline uint32_t waitcnt2(uint32_t target, uint32_t delta) {
  return waitcnt(target) + delta;
}

//# helper read_ports
//#   needs: simpletools.h/Io port
//#   fidelity: a property of each port as 32 bits
inline uint32_t read_ports(bool (Io::*property)() const) {
  uint32_t bits = 0;
  for (int8_t number = 31; number >= 0; number--) bits = bits << 1 | (Io(port(number)).*property)();
  return bits;
}

//# register INA
//#   needs: simpletools.h/Io read_ports
//#   fidelity: levels at the pins; they are read one after the other, in some 150 us
const struct {
  operator uint32_t() const { return read_ports(&Io::high); }
} INA = {};

//# register _INA
//#   needs: INA
//#   fidelity: as INA
const auto &_INA = INA;

//# helper PortRegister
//#   needs: simpletools.h/Io port read_ports
//#   fidelity: only the bits that change are written, so that pins that other functions drive stay as they are
struct PortRegister {
  bool directions;

  uint32_t bits() const { return read_ports(directions ? &Io::driven : &Io::latch); }
  operator uint32_t() const { return bits(); }
  const PortRegister &operator=(uint32_t value) const {
    uint32_t changed = value ^ bits();
    for (uint8_t number = 0; number < 32; number++, value >>= 1, changed >>= 1) {
      if (!(changed & 1)) continue;
      Io io(port(number));
      if (directions) io.drive(value & 1);
      else io.set(value & 1);
    }
    return *this;
  }
  const PortRegister &operator=(const PortRegister &other) const { return *this = other.bits(); }
  const PortRegister &operator|=(uint32_t value) const { return *this = bits() | value; }
  const PortRegister &operator&=(uint32_t value) const { return *this = bits() & value; }
  const PortRegister &operator^=(uint32_t value) const { return *this = bits() ^ value; }
};

//# register OUTA
//#   needs: PortRegister
//#   fidelity: the output latches of the whole program; on the Propeller each cog has its own. Bits change one after the other, in some 400 us
//#   limit: ports that are not wired keep no bit: 0 is read
const PortRegister OUTA = {false};

//# register DIRA
//#   needs: PortRegister
//#   fidelity: the directions of the whole program; on the Propeller each cog has its own. Bits change one after the other, in some 400 us
//#   limit: ports that are not wired keep no bit: 0 is read
const PortRegister DIRA = {true};

//# register _OUTA
//#   needs: PortRegister OUTA
//#   fidelity: as OUTA
const PortRegister &_OUTA = OUTA;

//# register _DIRA
//#   needs: PortRegister DIRA
//#   fidelity: as DIRA
const PortRegister &_DIRA = DIRA;

//# adapter waitpeq
//#   for: void waitpeq(unsigned int state, unsigned int mask)
//#   kind: semantic
//#   needs: INA
//#   fidelity: within 200 us
//#   limit: a state that lasts less than 200 us can be missed
inline void waitpeq(uint32_t state, uint32_t mask) {
  while ((INA & mask) != state) yield();
}

//# adapter waitpne
//#   for: void waitpne(unsigned int state, unsigned int mask)
//#   kind: semantic
//#   needs: INA
//#   fidelity: within 200 us
//#   limit: a state that lasts less than 200 us can be missed
inline void waitpne(uint32_t state, uint32_t mask) {
  while ((INA & mask) == state) yield();
}

//# helper locks_given
//#   fidelity: which of the eight locks are given out
static uint8_t locks_given = 0;

//# helper locks_set
//#   fidelity: which of the eight locks are set
static uint8_t locks_set = 0;

//# adapter locknew
//#   for: int locknew(void)
//#   kind: semantic
//#   needs: locks_given
//#   fidelity: exact: the number of a lock, -1 when all eight are given out
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
inline void lockret(int32_t lockid) {
  locks_given &= ~(1 << (lockid & 7));
}

//# adapter lockset
//#   for: int lockset(int lockid)
//#   kind: semantic
//#   needs: locks_set
//#   fidelity: exact: -1 when the lock was set already, else 0
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
inline int32_t lockclr(int32_t lockid) {
  bool before = locks_set >> (lockid & 7) & 1;
  locks_set &= ~(1 << (lockid & 7));
  return -(int32_t)before;
}
