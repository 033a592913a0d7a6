//# header simpletools.h
// Pins, time, pulses, shifting, EEPROM and arithmetic. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Utility/libsimpletools.
// A pin is one of the target here; any other number is a port that is not wired, where nothing happens and 0 is read.

// ---------------------------------------------------------------- pins

//# helper Io
//#   fidelity: OUTA and DIRA are independent on the Propeller and a released pin floats. PORT = 1 at an input of an AVR is a pull-up, so the
//#   fidelity: output latch is kept here, and reaches PORT only while the pin is an output.
static uint8_t latches[(NUM_DIGITAL_PINS + 7) / 8];

struct Io {  // one pin, ready for access to its registers
  uint8_t pin, mask;
  volatile uint8_t *in, *direction, *out;

  explicit Io(int32_t number) : pin(number), mask(0), in(0), direction(0), out(0) {
    if (number < 0 || number >= NUM_DIGITAL_PINS) return;
    uint8_t port = digitalPinToPort(pin);
    mask = digitalPinToBitMask(pin);
    in = portInputRegister(port);
    direction = portModeRegister(port);
    out = portOutputRegister(port);
  }
  bool wired() const { return mask != 0; }
  bool high() const { return wired() && (*in & mask); }
  bool driven() const { return wired() && (*direction & mask); }
  bool latch() const { return wired() && (latches[pin >> 3] >> (pin & 7) & 1); }
  void put(volatile uint8_t *to, bool value) const {
    uint8_t old = SREG;
    cli();
    if (value) *to |= mask;
    else *to &= ~mask;
    SREG = old;
  }
  void set(bool value) const {
    if (!wired()) return;
    uint8_t bit = 1 << (pin & 7);
    if (value) latches[pin >> 3] |= bit;
    else latches[pin >> 3] &= ~bit;
    if (driven()) put(out, value);
  }
  void drive(bool output) const {
    if (!wired()) return;
    if (output) {
      put(out, latch());
      put(direction, true);
    } else {
      put(direction, false);
      put(out, false);
    }
  }
};

//# helper drive_level
//#   needs: Io
inline void drive_level(int32_t pin, bool value) {
  Io io(pin);
  if (!io.wired()) return;
  digitalWrite(io.pin, value);  // which ends a wave of a timer there
  io.set(value);
  io.drive(true);
}

//# adapter high
//#   for: void high(int pin)
//#   kind: oneToMany
//#   needs: drive_level
//#   pin: pin digital out
//#   fidelity: exact
inline void high(int32_t pin) {
  drive_level(pin, true);
}

//# adapter low
//#   for: void low(int pin)
//#   kind: oneToMany
//#   needs: drive_level
//#   pin: pin digital out
//#   fidelity: exact
inline void low(int32_t pin) {
  drive_level(pin, false);
}

//# adapter get_state
//#   for: unsigned int get_state(int pin)
//#   kind: oneToOne
//#   needs: Io
//#   pin: pin digital in
//#   fidelity: exact
inline uint32_t get_state(int32_t pin) {
  return Io(pin).high();
}

//# adapter input
//#   for: unsigned int input(int pin)
//#   kind: oneToMany
//#   needs: Io
//#   pin: pin digital in
//#   fidelity: exact; the output latch is kept
inline uint32_t input(int32_t pin) {
  Io io(pin);
  io.drive(false);
  return io.high();
}

//# adapter get_output
//#   for: unsigned int get_output(int pin)
//#   kind: semantic
//#   needs: Io
//#   pin: pin digital both
//#   fidelity: the latch of the whole program; on the Propeller each cog has one of its own
inline uint32_t get_output(int32_t pin) {
  return Io(pin).latch();
}

//# adapter get_direction
//#   for: unsigned int get_direction(int pin)
//#   kind: oneToOne
//#   needs: Io
//#   pin: pin digital both
//#   fidelity: exact for a program on one cog
inline uint32_t get_direction(int32_t pin) {
  return Io(pin).driven();
}

//# adapter set_output
//#   for: void set_output(int pin, int state)
//#   kind: semantic
//#   needs: Io
//#   pin: pin digital out
//#   fidelity: exact
inline void set_output(int32_t pin, int32_t state) {
  Io(pin).set(state & 1);
}

//# adapter set_direction
//#   for: void set_direction(int pin, int direction)
//#   kind: semantic
//#   needs: Io
//#   pin: pin digital both
//#   fidelity: exact
inline void set_direction(int32_t pin, int32_t direction) {
  Io(pin).drive(direction & 1);
}

//# adapter toggle
//#   for: unsigned int toggle(int pin)
//#   kind: oneToMany
//#   needs: Io
//#   pin: pin digital out
//#   fidelity: exact: the latch is inverted and the pin becomes an output
inline uint32_t toggle(int32_t pin) {
  Io io(pin);
  io.set(!io.latch());
  io.drive(true);
  return io.latch();
}

//# adapter reverse
//#   for: unsigned int reverse(int pin)
//#   kind: oneToMany
//#   needs: Io
//#   pin: pin digital both
//#   fidelity: exact
inline uint32_t reverse(int32_t pin) {
  Io io(pin);
  io.drive(!io.driven());
  return io.driven();
}

// ---------------------------------------------------------------- time

//# helper pause_ticks
//#   fidelity: the unit of pause in ticks of 12.5 ns
static int32_t pause_ticks = 80000L;

//# helper io_ticks
//#   fidelity: the unit of timed input and output in ticks of 12.5 ns
static int32_t io_ticks = 80;

//# helper io_timeout_ticks
//#   fidelity: how long timed input waits, in ticks of 12.5 ns
static int32_t io_timeout_ticks = 20000000L;

//# variable ms
//#   fidelity: exact: ticks in a millisecond, no time
const int32_t ms = 80000L;

//# variable us
//#   fidelity: exact: ticks in a microsecond, no time
const int32_t us = 80L;

//# adapter pause
//#   for: void pause(int time)
//#   kind: oneToOne
//#   needs: pause_ticks propeller.h/waitcnt propeller.h/CNT
//#   fidelity: within 0.1 %
inline void pause(int32_t time) {
  if (pause_ticks == 80000L) {
    delay((uint32_t)time);
    return;
  }
  for (uint32_t at = CNT; time > 0; time--) waitcnt(at += pause_ticks);
}

//# adapter set_pause_dt
//#   for: void set_pause_dt(int clockticks)
//#   kind: oneToOne
//#   needs: pause_ticks
//#   fidelity: exact
inline void set_pause_dt(int32_t clockticks) {
  pause_ticks = clockticks;
}

//# adapter set_io_dt
//#   for: void set_io_dt(int clockticks)
//#   kind: oneToOne
//#   needs: io_ticks
//#   fidelity: exact
inline void set_io_dt(int32_t clockticks) {
  io_ticks = clockticks;
}

//# adapter set_io_timeout
//#   for: void set_io_timeout(int clockticks)
//#   kind: oneToOne
//#   needs: io_timeout_ticks
//#   fidelity: exact
inline void set_io_timeout(int32_t clockticks) {
  io_timeout_ticks = clockticks;
}

// ---------------------------------------------------------------- timed input and output

//# helper edge_cycles
//#   fidelity: micros() moves in steps of 4 us; counting up to the next step of Timer0 makes an edge known to 6 cycles
inline uint32_t edge_cycles() {  // the time in cycles, as of the call
  uint8_t old = SREG, turns = 0;
  cli();
  uint8_t tick = TCNT0;
  asm volatile(
      "1: in __tmp_reg__, %1\n\tcp __tmp_reg__, %2\n\tbrne 2f\n\tinc %0\n\trjmp 1b\n2:"
      : "+r"(turns)
      : "I"(_SFR_IO_ADDR(TCNT0)), "r"(tick));
  uint32_t cycles = micros() * clockCyclesPerMicrosecond();
  SREG = old;
  return cycles - turns * 6u;
}

//# helper holds
//#   needs: Io
inline bool holds(const Io &io, uint8_t level, uint32_t begun, uint32_t limit) {  // waits while the pin has the level; true after the limit
  uint16_t burst = limit > 20000 ? 2000 : 60;                                   // the clock is looked at rarely: that costs 4 us
  do {
    for (uint16_t turn = burst; turn; turn--)
      if ((*io.in & io.mask) != level) return false;
  } while (micros() - begun < limit);
  return true;
}

//# helper in_units
//#   needs: io_ticks
inline int32_t in_units(uint32_t cycles) {
  uint32_t micros_ = (cycles + clockCyclesPerMicrosecond() / 2) / clockCyclesPerMicrosecond();
  return io_ticks == 80 ? micros_ : micros_ * 80 / io_ticks;
}

//# adapter pulse_in
//#   for: int pulse_in(int pin, int state)
//#   kind: oneToMany
//#   needs: Io holds edge_cycles in_units io_timeout_ticks
//#   pin: pin digital in
//#   fidelity: within 1 us; 0 when no pulse begins in time, the part seen when it does not end
//#   limit: other cogs wait meanwhile
inline int32_t pulse_in(int32_t pin, int32_t state) {
  Io io(pin);
  if (!io.wired()) return 0;
  io.drive(false);
  uint8_t level = state ? io.mask : 0, other = io.mask ^ level;
  uint32_t limit = (uint32_t)io_timeout_ticks / 80, begun = micros();
  if (holds(io, level, begun, limit) || holds(io, other, begun, limit)) return 0;
  uint32_t from = edge_cycles();
  holds(io, level, begun, limit);
  return in_units(edge_cycles() - from);
}

//# adapter rc_time
//#   for: long rc_time(int pin, int state)
//#   kind: oneToMany
//#   needs: Io holds edge_cycles in_units io_timeout_ticks
//#   pin: pin digital in
//#   fidelity: within 2 us
//#   limit: at 5 V a decay takes some 15 to 20 % longer than at 3.3 V: check the program's limits
//#   limit: other cogs wait meanwhile
inline int32_t rc_time(int32_t pin, int32_t state) {
  Io io(pin);
  if (!io.wired()) return 0;
  uint32_t begun = micros();
  io.drive(false);
  uint32_t from = edge_cycles();
  holds(io, state ? io.mask : 0, begun, (uint32_t)io_timeout_ticks / 80);
  return in_units(edge_cycles() - from);
}

//# adapter pulse_out
//#   for: void pulse_out(int pin, int time)
//#   kind: oneToMany
//#   needs: Io io_ticks
//#   pin: pin digital out
//#   fidelity: within 0.5 us or 1 %; the pulse is the inverse of the output latch
inline void pulse_out(int32_t pin, int32_t time) {
  Io io(pin);
  if (!io.wired()) return;
  uint32_t width = io_ticks == 80 ? (uint32_t)time : (uint32_t)time * io_ticks / 80;
  io.drive(true);
  uint8_t old = SREG;
  cli();
  if (width < 40) {
    *io.in = io.mask;  // a one written to PINx inverts PORTx
    delayMicroseconds(width);
    *io.in = io.mask;
    SREG = old;
    return;
  }
  uint8_t tick = TCNT0;
  while (TCNT0 == tick) {}
  *io.in = io.mask;
  uint32_t begun = micros();
  SREG = old;
  while (micros() - begun < width - 28) {}
  cli();
  tick = TCNT0;
  while (TCNT0 == tick) {}
  int16_t rest = (int16_t)(width - (micros() - begun)) - 3;
  if (rest > 1) delayMicroseconds(rest);
  *io.in = io.mask;
  SREG = old;
}

//# adapter count
//#   for: long count(int pin, long duration)
//#   kind: semantic
//#   needs: Io
//#   pin: pin digital in
//#   fidelity: rising edges in so many milliseconds
//#   limit: it polls: up to about 100 kHz, and other cogs wait meanwhile
inline int32_t count(int32_t pin, int32_t duration) {
  Io io(pin);
  if (!io.wired()) {
    delay((uint32_t)duration);
    return 0;
  }
  io.drive(false);
  int32_t edges = 0;
  uint8_t last = *io.in & io.mask;
  for (uint32_t begun = millis(); millis() - begun < (uint32_t)duration;) {
    uint8_t now = *io.in & io.mask;
    edges += now && !last;
    last = now;
  }
  return edges;
}

//# adapter freqout
//#   for: void freqout(int pin, int msTime, int frequency)
//#   kind: oneToMany
//#   needs: Io low
//#   timer: Timer2
//#   pin: pin digital out
//#   fidelity: 1 % in frequency from 31 Hz up to 65 kHz; the burst ends with the call and the pin as an input
//#   limit: one tone at a time, and only square waves
inline void freqout(int32_t pin, int32_t msTime, int32_t frequency) {
  Io io(pin);
  if (!io.wired() || frequency <= 0) {
    delay((uint32_t)msTime);
    return;
  }
  low(pin);
  tone(io.pin, (unsigned int)frequency);
  delay((uint32_t)msTime);
  noTone(io.pin);
  io.drive(false);
}
