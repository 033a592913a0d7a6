//# header simpletools.h
// Pins, time, pulses, shifting, EEPROM and arithmetic in C. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Utility/libsimpletools.
// A pin is AVR_PIN(port, bit) here; any other number is a port that is not wired, where nothing happens and 0 is read.

// ---------------------------------------------------------------- pins

//# helper Io
//#   include: <avr/interrupt.h>
//#   fidelity: OUTA and DIRA are independent on the Propeller and a released pin floats. PORT = 1 at an input of an AVR is a pull-up, so the
//#   fidelity: output latch is kept here, and reaches PORT only while the pin is an output.
//#   ram: 24
typedef struct {  // one pin, ready for access to its registers
  uint8_t number, mask;  // mask: 0 where there is no pin
  volatile uint8_t *in;  // PINx; DDRx and PORTx stand behind it
} Io;
enum { IO_DIRECTION = 1, IO_OUT = 2 };
static uint8_t io_latches[12], io_outputs[12];  // a pin that only rests at a level since before main is no output

static inline Io io_at(int32_t number) {
  const uint16_t ports = 0
#ifdef PORTA
      | 1 << 0
#endif
#ifdef PORTB
      | 1 << 1
#endif
#ifdef PORTC
      | 1 << 2
#endif
#ifdef PORTD
      | 1 << 3
#endif
#ifdef PORTE
      | 1 << 4
#endif
#ifdef PORTF
      | 1 << 5
#endif
#ifdef PORTG
      | 1 << 6
#endif
#ifdef PORTH
      | 1 << 7
#endif
#ifdef PORTJ
      | 1 << 9
#endif
#ifdef PORTK
      | 1 << 10
#endif
#ifdef PORTL
      | 1 << 11
#endif
      ;
  Io io = {(uint8_t)number, 0, 0};
  if (number < 0 || number >= 96 || !(ports >> (number >> 3) & 1)) return io;
  uint8_t port = number >> 3;
  io.mask = 1 << (number & 7);
  io.in = (volatile uint8_t *)(port < 7 ? 0x20 + 3 * port : 0x100 + 3 * (port - (port > 7) - 7));
  return io;
}

static inline bool io_high(Io io) {
  return io.mask && *io.in & io.mask;
}

static inline bool io_driven(Io io) {
  return io.mask && io.in[IO_DIRECTION] & io.mask;
}

static inline bool io_owned(Io io) {
  return io.mask && io_outputs[io.number >> 3] & io.mask;
}

static inline bool io_latch(Io io) {
  return io.mask && io_latches[io.number >> 3] & io.mask;
}

static inline void io_put(Io io, uint8_t which, bool value) {
  uint8_t old = SREG;
  cli();
  if (value) io.in[which] |= io.mask;
  else io.in[which] &= ~io.mask;
  SREG = old;
}

static inline void io_set(Io io, bool value) {
  if (!io.mask) return;
  if (value) io_latches[io.number >> 3] |= io.mask;
  else io_latches[io.number >> 3] &= ~io.mask;
  if (io_driven(io)) io_put(io, IO_OUT, value);
}

static inline void io_drive(Io io, bool output) {
  if (!io.mask) return;
  uint8_t old = SREG;
  cli();
  if (output) io_outputs[io.number >> 3] |= io.mask;
  else io_outputs[io.number >> 3] &= ~io.mask;
  SREG = old;
  if (output) {
    io_put(io, IO_OUT, io_latch(io));
    io_put(io, IO_DIRECTION, true);
  } else {
    io_put(io, IO_DIRECTION, false);
    io_put(io, IO_OUT, false);
  }
}

//# adapter high
//#   for: void high(int pin)
//#   kind: oneToMany
//#   needs: Io
//#   pin: pin digital out
//#   fidelity: exact
static inline void high(int32_t pin) {
  io_set(io_at(pin), true);
  io_drive(io_at(pin), true);
}

//# adapter low
//#   for: void low(int pin)
//#   kind: oneToMany
//#   needs: Io
//#   pin: pin digital out
//#   fidelity: exact
static inline void low(int32_t pin) {
  io_set(io_at(pin), false);
  io_drive(io_at(pin), true);
}

//# adapter get_state
//#   for: unsigned int get_state(int pin)
//#   kind: oneToOne
//#   needs: Io
//#   pin: pin digital in
//#   fidelity: exact
static inline uint32_t get_state(int32_t pin) {
  return io_high(io_at(pin));
}

//# adapter input
//#   for: unsigned int input(int pin)
//#   kind: oneToMany
//#   needs: Io
//#   pin: pin digital in
//#   fidelity: exact; the output latch is kept
static inline uint32_t input(int32_t pin) {
  io_drive(io_at(pin), false);
  return io_high(io_at(pin));
}

//# adapter get_output
//#   for: unsigned int get_output(int pin)
//#   kind: semantic
//#   needs: Io
//#   pin: pin digital both
//#   fidelity: the latch of the whole program; on the Propeller each cog has one of its own
static inline uint32_t get_output(int32_t pin) {
  return io_latch(io_at(pin));
}

//# adapter get_direction
//#   for: unsigned int get_direction(int pin)
//#   kind: oneToOne
//#   needs: Io
//#   pin: pin digital both
//#   fidelity: exact for a program on one cog
static inline uint32_t get_direction(int32_t pin) {
  return io_owned(io_at(pin));
}

//# adapter set_output
//#   for: void set_output(int pin, int state)
//#   kind: semantic
//#   needs: Io
//#   pin: pin digital out
//#   fidelity: exact
static inline void set_output(int32_t pin, int32_t state) {
  io_set(io_at(pin), state != 0);
}

//# adapter set_direction
//#   for: void set_direction(int pin, int direction)
//#   kind: semantic
//#   needs: Io
//#   pin: pin digital both
//#   fidelity: exact
static inline void set_direction(int32_t pin, int32_t direction) {
  io_drive(io_at(pin), direction != 0);
}

//# adapter toggle
//#   for: unsigned int toggle(int pin)
//#   kind: oneToMany
//#   needs: Io
//#   pin: pin digital out
//#   fidelity: exact: the latch is inverted and the pin becomes an output
static inline uint32_t toggle(int32_t pin) {
  Io io = io_at(pin);
  io_set(io, !io_latch(io));
  io_drive(io, true);
  return io_latch(io);
}

//# adapter reverse
//#   for: unsigned int reverse(int pin)
//#   kind: oneToMany
//#   needs: Io
//#   pin: pin digital both
//#   fidelity: exact
static inline uint32_t reverse(int32_t pin) {
  Io io = io_at(pin);
  io_drive(io, !io_owned(io));
  return io_owned(io);
}

//# adapter get_states
//#   for: unsigned int get_states(int endPin, int startPin)
//#   kind: oneToMany
//#   symmetric: endPin startPin
//#   needs: Io propeller.h/port
//#   fidelity: levels; the pins are read one after the other, within some 5 us each
static inline uint32_t get_states(int32_t endPin, int32_t startPin) {
  int32_t first = endPin < startPin ? endPin : startPin, last = endPin < startPin ? startPin : endPin;
  uint32_t pattern = 0;
  for (; last >= first; last--) pattern = pattern << 1 | io_high(io_at(port(last)));
  return pattern;
}

//# adapter get_outputs
//#   for: unsigned int get_outputs(int endPin, int startPin)
//#   kind: oneToMany
//#   symmetric: endPin startPin
//#   needs: Io propeller.h/port
//#   fidelity: output latches; the pins are read one after the other, within some 5 us each
static inline uint32_t get_outputs(int32_t endPin, int32_t startPin) {
  int32_t first = endPin < startPin ? endPin : startPin, last = endPin < startPin ? startPin : endPin;
  uint32_t pattern = 0;
  for (; last >= first; last--) pattern = pattern << 1 | io_latch(io_at(port(last)));
  return pattern;
}

//# adapter get_directions
//#   for: unsigned int get_directions(int endPin, int startPin)
//#   kind: oneToMany
//#   symmetric: endPin startPin
//#   needs: Io propeller.h/port
//#   fidelity: directions; the pins are read one after the other, within some 5 us each
static inline uint32_t get_directions(int32_t endPin, int32_t startPin) {
  int32_t first = endPin < startPin ? endPin : startPin, last = endPin < startPin ? startPin : endPin;
  uint32_t pattern = 0;
  for (; last >= first; last--) pattern = pattern << 1 | io_owned(io_at(port(last)));
  return pattern;
}

//# adapter set_outputs
//#   for: void set_outputs(int endPin, int startPin, unsigned int pattern)
//#   kind: oneToMany
//#   symmetric: endPin startPin
//#   needs: Io propeller.h/port
//#   fidelity: output latches; the pins change one after the other, within some 5 us each; what a pattern has beyond its ports sets those that follow
static inline void set_outputs(int32_t endPin, int32_t startPin, uint32_t pattern) {
  int32_t first = endPin < startPin ? endPin : startPin, last = endPin < startPin ? startPin : endPin;
  for (; first <= last || (pattern && first < 32); first++, pattern >>= 1)
    if (first <= last || pattern & 1) io_set(io_at(port(first)), pattern & 1);
}

//# adapter set_directions
//#   for: void set_directions(int endPin, int startPin, unsigned int pattern)
//#   kind: oneToMany
//#   symmetric: endPin startPin
//#   needs: Io propeller.h/port
//#   fidelity: directions; the pins change one after the other, within some 5 us each; what a pattern has beyond its ports sets those that follow
static inline void set_directions(int32_t endPin, int32_t startPin, uint32_t pattern) {
  int32_t first = endPin < startPin ? endPin : startPin, last = endPin < startPin ? startPin : endPin;
  for (; first <= last || (pattern && first < 32); first++, pattern >>= 1)
    if (first <= last || pattern & 1) io_drive(io_at(port(first)), pattern & 1);
}

// ---------------------------------------------------------------- time

//# helper pause_unit
//#   fidelity: the unit of pause in ticks of 12.5 ns
//#   ram: 4
static int32_t pause_unit = 80000L;

//# helper io_ticks
//#   fidelity: the unit of timed input and output in ticks of 12.5 ns
//#   ram: 4
static int32_t io_ticks = 80;

//# helper io_timeout_ticks
//#   fidelity: how long timed input waits, in ticks of 12.5 ns
//#   ram: 4
static int32_t io_timeout_ticks = 20000000L;

//# variable ms
//#   fidelity: exact: ticks in a millisecond, no time
const int32_t ms = 80000L;

//# variable us
//#   fidelity: exact: ticks in a microsecond, no time
const int32_t us = 80L;

//# adapter set_pause_dt
//#   for: void set_pause_dt(int clockticks)
//#   kind: oneToOne
//#   needs: pause_unit
//#   fidelity: exact
static inline void set_pause_dt(int32_t clockticks) {
  pause_unit = clockticks;
}

//# adapter set_io_dt
//#   for: void set_io_dt(int clockticks)
//#   kind: oneToOne
//#   needs: io_ticks
//#   fidelity: exact
static inline void set_io_dt(int32_t clockticks) {
  io_ticks = clockticks;
}

//# adapter set_io_timeout
//#   for: void set_io_timeout(int clockticks)
//#   kind: oneToOne
//#   needs: io_timeout_ticks
//#   fidelity: exact
static inline void set_io_timeout(int32_t clockticks) {
  io_timeout_ticks = clockticks;
}

//# adapter pause_ticks
//#   for: void pause_ticks(unsigned int pticks)
//#   kind: oneToMany
//#   needs: propeller.h/wait_until propeller.h/CNT
//#   fidelity: within 8 us
static inline void pause_ticks(uint32_t pticks) {
  wait_until(pticks + CNT);
}

//# helper mark_ticks
//#   fidelity: when mark was called, in ticks of 12.5 ns
//#   ram: 4
static uint32_t mark_ticks = 0;

//# adapter mark
//#   for: void mark(void)
//#   kind: semantic
//#   needs: mark_ticks propeller.h/CNT
//#   fidelity: within 4 us
static inline void mark(void) {
  mark_ticks = CNT;
}

//# adapter timeout
//#   for: int timeout(int time)
//#   kind: semantic
//#   needs: mark_ticks io_ticks propeller.h/CNT
//#   fidelity: within 8 us; up to 53.7 s after mark, as there
static inline int32_t timeout(int32_t time) {
  return CNT - mark_ticks >= (uint32_t)time * (uint32_t)io_ticks;
}

//# adapter wait
//#   for: void wait(int time)
//#   kind: semantic
//#   needs: mark_ticks io_ticks propeller.h/waitcnt
//#   fidelity: within 8 us, without drift: each wait begins where the one before it ended
static inline void wait(int32_t time) {
  waitcnt(mark_ticks += (uint32_t)time * (uint32_t)io_ticks);
}

//# adapter pause
//#   for: void pause(int time)
//#   kind: oneToOne
//#   needs: pause_unit propeller.h/clock_wait propeller.h/wait_until propeller.h/CNT
//#   fidelity: within 0.1 %
static inline void pause(int32_t time) {
  if (pause_unit == 80000L) {
    clock_wait(time);
    return;
  }
  for (uint32_t at = CNT; time > 0; time--) wait_until(at += pause_unit);
}

// ---------------------------------------------------------------- timed input and output

//# helper timed_input
//#   fidelity: what drives calculate every 20 ms waits while an input is timed: up to 20 ms for the edge that begins it, and up to 20 ms for
//#   fidelity: the one that ends it
//#   ram: 3
static volatile uint8_t frames_wait;  // for how many periods of 1,024 us frame jobs wait
static void (*frames_due)(void);      // does those that have waited

static inline void edge_found(void) { frames_wait = 20; }

static inline void end_timed_input(void) {
  frames_wait = 0;
  if (frames_due) frames_due();
}

//# helper edge_cycles
//#   needs: propeller.h/clock_us
//#   include: <avr/interrupt.h>
//#   fidelity: clock_us() moves in steps of 4 us; counting up to the next step of Timer0 makes an edge known to 6 cycles
static inline uint32_t edge_cycles(void) {  // the time in cycles, as of the call
  uint8_t old = SREG, turns = 0;
  cli();
  uint8_t tick = TCNT0;
  asm volatile(
      "1: in __tmp_reg__, %1\n\tcp __tmp_reg__, %2\n\tbrne 2f\n\tinc %0\n\trjmp 1b\n2:"
      : "+r"(turns)
      : "I"(_SFR_IO_ADDR(TCNT0)), "r"(tick));
  uint32_t cycles = clock_us() * (F_CPU / 1000000UL);
  SREG = old;
  return cycles - turns * 6u;
}

//# helper leaves
//#   needs: Io edge_cycles propeller.h/clock_us
//#   fidelity: an edge is known to 1 us; one that came while an interrupt ran, to half of the time that it took
static inline bool leaves(Io io, uint8_t level, uint32_t begun, uint32_t limit, uint32_t *at) {  // waits while the pin has the level
  uint16_t burst = limit > 20000 ? 2000 : 60;  // the clock is looked at rarely: that costs 4 us
  uint8_t tick = TCNT0, now, turns = 0;         // the last look with that level: so many turns of 14 cycles behind that step of Timer0
  do {
    for (uint16_t turn = burst; turn; turn--) {
      now = TCNT0;
      if ((*io.in & io.mask) != level) {
        *at = edge_cycles();
        *at -= (uint16_t)((uint16_t)*at - tick * 64u - turns * 14u) % 16384 / 2;
        return true;
      }
      turns++;
      if (now == tick) continue;
      tick = now;
      turns = 0;
    }
  } while (clock_us() - begun < limit);
  *at = edge_cycles();
  return false;
}

//# helper in_units
//#   needs: io_ticks
static inline int32_t in_units(uint32_t cycles) {
  uint32_t micros_ = (cycles + (F_CPU / 1000000UL) / 2) / (F_CPU / 1000000UL);
  return io_ticks == 80 ? micros_ : micros_ * 80 / io_ticks;
}

//# helper asking
//#   fidelity: the pin that asks and the one that answers, of a component with a wire for each direction; else the pin itself is both
static inline int32_t asking(int32_t pin) {
#ifdef SPLIT_WIRES
  for (uint8_t i = 0; i < sizeof split_wires / sizeof split_wires[0]; i++)
    if (split_wires[i].answers == pin) return split_wires[i].asks;
#endif
  return pin;
}

static inline int32_t answering(int32_t pin) {
#ifdef SPLIT_WIRES
  for (uint8_t i = 0; i < sizeof split_wires / sizeof split_wires[0]; i++)
    if (split_wires[i].asks == pin || split_wires[i].answers == pin) return split_wires[i].answers;
#endif
  return pin;
}

//# adapter pulse_in
//#   for: int pulse_in(int pin, int state)
//#   kind: oneToMany
//#   needs: Io propeller.h/clock_us leaves timed_input in_units io_timeout_ticks
//#   pin: pin digital in
//#   fidelity: within 2 us; 0 when no pulse begins in time, the part seen when it does not end
//#   limit: the time of an edge during an interrupt is wrong by up to 12 us beside servos, 22 us where interrupts meet
//#   limit: other cogs wait meanwhile
static inline int32_t pulse_in(int32_t pin, int32_t state) {
  Io io = io_at(pin);
  if (!io.mask) return 0;
  io_drive(io, false);
  uint8_t level = state ? io.mask : 0, other = io.mask ^ level;
  edge_found();
  uint32_t limit = (uint32_t)io_timeout_ticks / 80, begun = clock_us(), from, to = 0;
  bool found = leaves(io, level, begun, limit, &from) && leaves(io, other, begun, limit, &from);
  if (found) {
    edge_found();
    leaves(io, level, begun, limit, &to);
  }
  end_timed_input();
  return found ? in_units(to - from) : 0;
}

//# adapter rc_time
//#   for: long rc_time(int pin, int state)
//#   kind: oneToMany
//#   needs: Io propeller.h/clock_us leaves timed_input edge_cycles in_units io_timeout_ticks
//#   pin: pin digital in
//#   fidelity: within 2 us
//#   limit: the time of an edge during an interrupt is wrong by up to 12 us beside servos, 22 us where interrupts meet
//#   limit: at 5 V a decay takes some 15 to 20 % longer than at 3.3 V: check the program's limits
//#   limit: other cogs wait meanwhile
static inline int32_t rc_time(int32_t pin, int32_t state) {
  Io io = io_at(pin);
  if (!io.mask) return 0;
  edge_found();
  uint8_t old = SREG;
  cli();
  io_drive(io, false);
  uint32_t from = edge_cycles(), begun = clock_us(), to;
  SREG = old;
  leaves(io, state ? io.mask : 0, begun, (uint32_t)io_timeout_ticks / 80, &to);
  end_timed_input();
  return in_units(to - from);
}

//# adapter pulse_out
//#   for: void pulse_out(int pin, int time)
//#   kind: oneToMany
//#   needs: Io io_ticks timed_input propeller.h/clock_us
//#   include: <avr/interrupt.h> <util/delay_basic.h>
//#   pin: pin digital out
//#   fidelity: within 0.5 us or 1 %; the pulse is the inverse of the output latch
static inline void pulse_delay(uint16_t width) {  // microseconds, less what stands around the call
  uint16_t turns = width * (uint16_t)(F_CPU / 4000000UL);
  if (turns > 3) _delay_loop_2(turns - 3);
}

static inline void pulse_at(Io io, uint32_t width) {
  uint8_t old = SREG;
  cli();
  if (width < 40) {
    *io.in = io.mask;  // a one written to PINx inverts PORTx
    pulse_delay(width);
    *io.in = io.mask;
    SREG = old;
    return;
  }
  uint8_t tick = TCNT0;
  while (TCNT0 == tick) {}
  *io.in = io.mask;
  uint32_t begun = clock_us();
  SREG = old;
  while (clock_us() - begun < width - 28) {}
  cli();
  tick = TCNT0;
  while (TCNT0 == tick) {}
  int16_t rest = (int16_t)(width - (clock_us() - begun)) - 3;
  if (rest > 1) pulse_delay(rest);
  *io.in = io.mask;
  SREG = old;
}

static inline void pulse_out(int32_t pin, int32_t time) {
  Io io = io_at(pin);
  if (!io.mask) return;
  io_drive(io, true);
  if (frames_due) frames_due();
  edge_found();
  pulse_at(io, io_ticks == 80 ? (uint32_t)time : (uint32_t)time * io_ticks / 80);
  frames_wait = 3;  // what answers to the pulse may be timed next
}

//# adapter count
//#   for: long count(int pin, long duration)
//#   kind: semantic
//#   needs: Io timed_input propeller.h/clock_us propeller.h/clock_wait
//#   pin: pin digital in
//#   fidelity: rising edges in so many milliseconds
//#   limit: it polls: up to about 100 kHz
//#   limit: the pin becomes an input, so that a wave of square_wave at the same pin is not seen
static inline int32_t count(int32_t pin, int32_t duration) {
  Io io = io_at(pin);
  if (!io.mask) {
    clock_wait(duration);
    return 0;
  }
  io_drive(io, false);
  edge_found();
  int32_t edges = 0;
  uint8_t last = *io.in & io.mask;
  for (uint32_t begun = clock_us(); clock_us() - begun < (uint32_t)duration * 1000;) {
    for (uint8_t turn = 50; turn; turn--) {
      uint8_t now = *io.in & io.mask;
      edges += now && !last;
      last = now;
    }
    if (frames_wait > 1) continue;
    uint32_t stopped = clock_us();  // what has waited takes its time now, which does not count
    if (frames_due) frames_due();
    edge_found();
    last = *io.in & io.mask;
    begun += clock_us() - stopped;
  }
  end_timed_input();
  return edges;
}

//# helper wave
//#   mcu: atmega328p atmega2560
//#   include: <avr/interrupt.h>
//#   timer: Timer2
//#   vector: TIMER2_COMPA_vect
//#   fidelity: a square wave at one pin
//#   ram: 17
static volatile uint8_t *wave_in;
static volatile uint8_t wave_mask;

ISR(TIMER2_COMPA_vect) {
  *wave_in = wave_mask;  // a one written to PINx inverts PORTx
}

static inline void wave_stop(void) {
  TIMSK2 = 0;
}

static inline bool wave_start(volatile uint8_t *in, uint8_t mask, int32_t frequency) {  // false outside of 31 Hz to 65,535 Hz
  static const uint16_t dividers[] = {1, 8, 32, 64, 128, 256, 1024};
  wave_stop();
  if (frequency < 31 || frequency > 65535) return false;
  uint8_t choice = 0;
  uint32_t counts = (F_CPU / frequency + 1) / 2;
  while (counts / dividers[choice] > 256) choice++;
  wave_in = in;
  wave_mask = mask;
  OCR2A = (counts + dividers[choice] / 2) / dividers[choice] - 1;
  TCNT2 = 0;
  TCCR2A = _BV(WGM21);
  TCCR2B = choice + 1;
  TIFR2 = _BV(OCF2A);
  TIMSK2 = _BV(OCIE2A);
  return true;
}

//# helper wave
//#   mcu: atmega32u4
//#   include: <avr/interrupt.h>
//#   timer: Timer3
//#   vector: TIMER3_COMPA_vect
//#   fidelity: a square wave at one pin
//#   ram: 17
static volatile uint8_t *wave_in;
static volatile uint8_t wave_mask;

ISR(TIMER3_COMPA_vect) {
  *wave_in = wave_mask;  // a one written to PINx inverts PORTx
}

static inline void wave_stop(void) {
  TIMSK3 = 0;
}

static inline bool wave_start(volatile uint8_t *in, uint8_t mask, int32_t frequency) {  // false outside of 31 Hz to 65,535 Hz
  wave_stop();
  if (frequency < 31 || frequency > 65535) return false;
  uint32_t counts = (F_CPU / frequency + 1) / 2;
  bool slow = counts > 65536;
  wave_in = in;
  wave_mask = mask;
  OCR3A = (uint16_t)((slow ? (counts + 4) / 8 : counts) - 1);
  TCNT3 = 0;
  TCCR3A = 0;
  TCCR3B = _BV(WGM32) | (slow ? _BV(CS31) : _BV(CS30));
  TIFR3 = _BV(OCF3A);
  TIMSK3 = _BV(OCIE3A);
  return true;
}

//# adapter freqout
//#   for: void freqout(int pin, int msTime, int frequency)
//#   kind: oneToMany
//#   needs: Io low wave propeller.h/clock_wait
//#   pin: pin digital out
//#   fidelity: 1 % in frequency from 31 Hz up to 65 kHz; the burst ends with the call and the pin as an input
//#   limit: one tone at a time; no tone below 31 Hz and above 65,535 Hz, where it only waits
//#   range: frequency 31..65535 or 0: it waits without a tone
static inline void freqout(int32_t pin, int32_t msTime, int32_t frequency) {
  Io io = io_at(pin);
  bool plays = false;
  if (io.mask) {
    low(pin);
    plays = wave_start(io.in, io.mask, frequency);
  }
  clock_wait(msTime);
  if (!plays) return;
  wave_stop();
  io_drive(io, false);
}

//# helper wave_pins
//#   fidelity: the pin of each channel of square_wave
//#   ram: 8
static int32_t wave_pins[2] = {-1, -1};

//# helper end_wave
//#   needs: Io wave wave_pins
static inline void end_wave(uint8_t channel) {
  Io io = io_at(wave_pins[channel]);
  wave_pins[channel] = -1;
  if (!io.mask) return;
  wave_stop();
  io_drive(io, false);
}

//# adapter square_wave
//#   for: void square_wave(int pin, int channel, int freq)
//#   kind: semantic
//#   needs: Io low wave wave_pins end_wave
//#   pin: pin digital out signed
//#   fidelity: 1 % in frequency from 31 Hz up to 65 kHz; a negative pin ends the channel's wave
//#   limit: one wave at a time: while one channel plays, the other stays silent
//#   limit: below 31 Hz and above 65,535 Hz there is no wave
//#   range: freq 31..65535 or 0: there is no wave
static inline void square_wave(int32_t pin, int32_t channel, int32_t freq) {
  uint8_t at = channel != 0;
  bool possible = freq >= 31 && freq <= 65535;
  if (pin != wave_pins[at] || !possible) end_wave(at);
  Io io = io_at(pin);
  if (!io.mask || !possible || wave_pins[!at] >= 0) return;
  wave_pins[at] = pin;
  low(pin);
  wave_start(io.in, io.mask, freq);
}

//# adapter square_wave_stop
//#   for: void square_wave_stop(void)
//#   kind: semantic
//#   needs: end_wave
//#   fidelity: exact; the pins become inputs
static inline void square_wave_stop(void) {
  end_wave(0);
  end_wave(1);
}

//# helper pwm_channels
//#   timer: Timer1
//#   fidelity: the pulses of each channel; `end` and that of the next cycle on are in counts of Timer1 from the begin of the cycle
//#   ram: 26
typedef struct {
  uint8_t pin, mask;
  volatile uint8_t *out;
  uint16_t end, next_end;
  uint32_t microseconds;
  bool high;
} PwmChannel;
static volatile PwmChannel pwm_channels[2];

//# helper pwm_cycle
//#   timer: Timer1
//#   fidelity: microseconds of the cycle, 0 while there is none
//#   ram: 4
static volatile uint32_t pwm_cycle = 0;

//# helper pwm_end_pulses
//#   needs: pwm_channels
//#   timer: Timer1
//#   fidelity: ends the pulses that are over within 4 us, and has the timer call at the end of the next one
static inline void pwm_end_pulses(void) {
  uint16_t next = 0xFFFF;
  for (uint8_t at = 0; at < 2; at++) {
    volatile PwmChannel *channel = &pwm_channels[at];
    if (!channel->high) continue;
    if (channel->end <= TCNT1 + 8) {
      *channel->out &= ~channel->mask;
      channel->high = false;
    } else if (channel->end < next) {
      next = channel->end;
    }
  }
  OCR1B = next;
}

//# helper pwm_counts
//#   needs: pwm_channels pwm_cycle pwm_end_pulses
//#   timer: Timer1
//#   include: <avr/interrupt.h>
//#   vector: TIMER1_COMPA_vect TIMER1_COMPB_vect
//#   stack: 20
//#   fidelity: half microseconds in cycles up to 32.7 ms, 4 us beyond
ISR(TIMER1_COMPA_vect) {  // a cycle begins
  for (uint8_t at = 0; at < 2; at++) {
    volatile PwmChannel *channel = &pwm_channels[at];
    channel->end = channel->next_end;
    if (!channel->end) continue;
    *channel->out |= channel->mask;
    channel->high = true;
  }
  pwm_end_pulses();
}
ISR(TIMER1_COMPB_vect) {
  pwm_end_pulses();
}
static inline uint16_t pwm_counts(uint32_t microseconds) {
  if (microseconds >= pwm_cycle) return microseconds ? 0xFFFF : 0;  // it never ends
  return pwm_cycle > 32767 ? microseconds / 4 : microseconds * 2;
}

//# adapter pwm_set
//#   for: void pwm_set(int pin, int channel, int tHigh)
//#   kind: semantic
//#   needs: Io pwm_channels pwm_cycle pwm_counts
//#   timer: Timer1
//#   pin: pin digital out
//#   fidelity: within 4 us, from the next cycle on
//#   limit: pulses shorter than 8 us come out up to 8 us long
static inline void pwm_set(int32_t pin, int32_t channel, int32_t tHigh) {
  volatile PwmChannel *it = &pwm_channels[channel != 0];
  Io before = io_at(it->pin), io = io_at(pin);
  volatile uint8_t *out = io.mask ? io.in + IO_OUT : 0;
  uint32_t microseconds = tHigh < 0 ? 0 : tHigh;
  uint8_t old = SREG;
  cli();
  bool same = it->out == out && it->mask == io.mask, moved = it->out && !same;
  it->pin = io.number;
  it->mask = io.mask;
  it->out = out;
  it->high = it->high && !moved;
  it->microseconds = io.mask ? microseconds : 0;
  it->next_end = io.mask ? pwm_counts(microseconds) : 0;
  SREG = old;
  if (moved) io_drive(before, false);
  if (pwm_cycle && !same) io_drive(io, true);  // which would cut a pulse
}

//# adapter pwm_start
//#   for: int pwm_start(unsigned int cycleMicroseconds)
//#   kind: semantic
//#   needs: Io pwm_channels pwm_cycle pwm_counts
//#   timer: Timer1
//#   fidelity: within 0.1 %; the number returned is not that of a cog
//#   limit: cycles of more than 262 ms are made 262 ms long
//#   limit: not together with servos, which need Timer1, too
static inline int32_t pwm_start(uint32_t cycleMicroseconds) {
  uint32_t cycle = cycleMicroseconds > 262144UL ? 262144UL : cycleMicroseconds < 20 ? 20 : cycleMicroseconds;
  bool slow = cycle > 32767;
  uint8_t old = SREG;
  cli();
  pwm_cycle = cycle;
  for (uint8_t at = 0; at < 2; at++) {
    volatile PwmChannel *channel = &pwm_channels[at];
    if (!channel->out) continue;
    channel->end = channel->next_end = pwm_counts(channel->microseconds);
    io_drive(io_at(channel->pin), true);
  }
  TCCR1A = 0;
  TCCR1B = _BV(WGM12) | (slow ? _BV(CS11) | _BV(CS10) : _BV(CS11));  // up to OCR1A, again and again
  OCR1A = (uint16_t)((slow ? cycle / 4 : cycle * 2) - 1);
  OCR1B = 0xFFFF;
  TCNT1 = 0;
  TIFR1 = _BV(OCF1A) | _BV(OCF1B);
  TIMSK1 = _BV(OCIE1A) | _BV(OCIE1B);
  SREG = old;
  return 2;
}

//# adapter pwm_stop
//#   for: void pwm_stop(void)
//#   kind: semantic
//#   needs: Io pwm_channels pwm_cycle
//#   timer: Timer1
//#   fidelity: exact: no more pulses, and the pins become inputs
static inline void pwm_stop(void) {
  TIMSK1 = 0;
  pwm_cycle = 0;
  for (uint8_t at = 0; at < 2; at++) {
    volatile PwmChannel *channel = &pwm_channels[at];
    channel->high = false;
    if (channel->out) io_drive(io_at(channel->pin), false);
  }
}

//# helper DutyRow
//#   fidelity: a pin at which a timer puts out pulses
typedef struct {
  uint8_t number, timer;
  volatile uint8_t *control;
  uint8_t bits;
  volatile uint8_t *compare;  // the lower half of one of 16 bits, whose upper half is 0
} DutyRow;

//# helper duty_rows
//#   mcu: atmega328p
//#   needs: DutyRow
//#   fidelity: the pins at which timers put out pulses, with their timer, its control register and bits, and their compare register
//#   ram: 42
static const DutyRow duty_rows[] = {
    {AVR_PIN('D', 6), 0, &TCCR0A, _BV(COM0A1), &OCR0A}, {AVR_PIN('D', 5), 0, &TCCR0A, _BV(COM0B1), &OCR0B},
    {AVR_PIN('B', 1), 1, &TCCR1A, _BV(COM1A1), &OCR1AL}, {AVR_PIN('B', 2), 1, &TCCR1A, _BV(COM1B1), &OCR1BL},
    {AVR_PIN('B', 3), 2, &TCCR2A, _BV(COM2A1), &OCR2A}, {AVR_PIN('D', 3), 2, &TCCR2A, _BV(COM2B1), &OCR2B},
};

//# helper duty_rows
//#   mcu: atmega2560
//#   needs: DutyRow
//#   fidelity: the pins at which timers put out pulses, with their timer, its control register and bits, and their compare register
//#   ram: 42
static const DutyRow duty_rows[] = {
    {AVR_PIN('B', 7), 0, &TCCR0A, _BV(COM0A1), &OCR0A}, {AVR_PIN('G', 5), 0, &TCCR0A, _BV(COM0B1), &OCR0B},
    {AVR_PIN('B', 5), 1, &TCCR1A, _BV(COM1A1), &OCR1AL}, {AVR_PIN('B', 6), 1, &TCCR1A, _BV(COM1B1), &OCR1BL},
    {AVR_PIN('B', 4), 2, &TCCR2A, _BV(COM2A1), &OCR2A}, {AVR_PIN('H', 6), 2, &TCCR2A, _BV(COM2B1), &OCR2B},
};

//# helper duty_rows
//#   mcu: atmega32u4
//#   needs: DutyRow
//#   fidelity: the pins at which timers put out pulses, with their timer, its control register and bits, and their compare register
//#   ram: 42
static const DutyRow duty_rows[] = {
    {AVR_PIN('B', 7), 0, &TCCR0A, _BV(COM0A1), &OCR0A}, {AVR_PIN('D', 0), 0, &TCCR0A, _BV(COM0B1), &OCR0B},
    {AVR_PIN('B', 5), 1, &TCCR1A, _BV(COM1A1), &OCR1AL}, {AVR_PIN('B', 6), 1, &TCCR1A, _BV(COM1B1), &OCR1BL},
};

//# helper put_duty
//#   needs: Io duty_rows propeller.h/clock_us
//#   timer: Timer0 Timer1 Timer2
//#   fidelity: pulses of a 256th of their cycle or more; Timer0 goes on counting for the clock
static inline void put_duty(Io io, uint8_t duty) {
  clock_us();
  for (uint8_t at = 0; at < sizeof duty_rows / sizeof *duty_rows; at++) {
    const DutyRow *row = &duty_rows[at];
    if (row->number != io.number) continue;
    uint8_t old = SREG;
    cli();
    if (!duty || duty == 255) {
      *row->control &= ~row->bits;
      io_put(io, IO_OUT, duty != 0);
    } else {
      if (row->timer == 0) TCCR0A |= _BV(WGM01) | _BV(WGM00);
      if (row->timer == 1) TCCR1A |= _BV(WGM10), TCCR1B = _BV(CS11) | _BV(CS10), row->compare[1] = 0;
#ifdef TCCR2A
      if (row->timer == 2) TCCR2A |= _BV(WGM20), TCCR2B = _BV(CS22);
#endif
      *row->compare = duty;
      *row->control |= row->bits;
    }
    io_put(io, IO_DIRECTION, true);
    SREG = old;
  }
}

//# helper dac_pins
//#   fidelity: the pin of each channel of dac_ctr
//#   ram: 8
static int32_t dac_pins[2] = {-1, -1};

//# helper dac_bits
//#   fidelity: resolution of dac_ctr
//#   ram: 1
static uint8_t dac_bits = 8;

//# helper end_dac
//#   needs: Io dac_pins put_duty
static inline void end_dac(uint8_t channel) {
  Io io = io_at(dac_pins[channel]);
  dac_pins[channel] = -1;
  if (!io.mask) return;
  put_duty(io, 0);
  io_drive(io, false);
}

//# adapter dac_ctr
//#   for: void dac_ctr(int pin, int channel, int dacVal)
//#   kind: semantic
//#   needs: Io dac_pins dac_bits end_dac put_duty
//#   pin: pin pwm out
//#   fidelity: the mean voltage within 0.4 % of the supply, which is 5 V here and 3.3 V there
//#   limit: 490 or 980 Hz instead of megahertz: a filter needs a hundred to a thousand times the capacity
//#   limit: 8 bits: further bits of the resolution are left out
//#   limit: at pins of Timer0, Timer1 and Timer2; not beside tones at pins of Timer2, nor servos and pwm_start at pins of Timer1
static inline void dac_ctr(int32_t pin, int32_t channel, int32_t dacVal) {
  uint8_t at = channel != 0;
  if (pin != dac_pins[at]) end_dac(at);
  Io io = io_at(pin);
  if (!io.mask) return;
  dac_pins[at] = pin;
  uint32_t fraction = (uint32_t)dacVal << (32 - dac_bits);  // of 2 to the power of 32; what does not fit is lost, as there
  put_duty(io, fraction >> 24);
}

//# adapter dac_ctr_res
//#   for: void dac_ctr_res(int bits)
//#   kind: oneToOne
//#   needs: dac_bits
//#   fidelity: exact; 0 means 8 bits
static inline void dac_ctr_res(int32_t bits) {
  dac_bits = bits > 0 && bits <= 32 ? bits : 8;
}

//# adapter dac_ctr_stop
//#   for: void dac_ctr_stop(void)
//#   kind: semantic
//#   needs: end_dac
//#   fidelity: exact; the pins become inputs
static inline void dac_ctr_stop(void) {
  end_dac(0);
  end_dac(1);
}

// ---------------------------------------------------------------- shifting

//# constant MSBPRE
#define MSBPRE 0L

//# constant LSBPRE
#define LSBPRE 1L

//# constant MSBPOST
#define MSBPOST 2L

//# constant LSBPOST
#define LSBPOST 3L

//# constant LSBFIRST
#define LSBFIRST 0L

//# constant MSBFIRST
#define MSBFIRST 1L

//# helper clock_pulse
//#   needs: Io
static inline void clock_pulse(Io clock) {
  io_set(clock, !io_latch(clock));
  io_set(clock, !io_latch(clock));
}

//# adapter shift_in
//#   for: int shift_in(int pinDat, int pinClk, int mode, int bits)
//#   kind: semantic
//#   needs: Io low clock_pulse MSBPRE LSBPRE MSBPOST
//#   pin: pinDat digital in
//#   pin: pinClk digital out
//#   fidelity: exact but for the clock, which is some 25 kHz
static inline int32_t shift_in(int32_t pinDat, int32_t pinClk, int32_t mode, int32_t bits) {
  bool before = mode == MSBPRE || mode == LSBPRE, highest = mode == MSBPRE || mode == MSBPOST;
  Io data = io_at(pinDat), clock = io_at(pinClk);
  uint32_t value = 0;
  io_drive(data, false);
  low(pinClk);
  for (uint8_t number = 0; number < bits; number++) {
    if (!before) clock_pulse(clock);
    uint32_t bit = io_high(data);
    value = highest ? value << 1 | bit : value | bit << number;
    if (before) clock_pulse(clock);
  }
  return (int32_t)value;
}

//# adapter shift_out
//#   for: void shift_out(int pinDat, int pinClk, int mode, int bits, int value)
//#   kind: semantic
//#   needs: Io low clock_pulse LSBFIRST
//#   pin: pinDat digital out
//#   pin: pinClk digital out
//#   fidelity: exact but for the clock, which is some 30 kHz
static inline void shift_out(int32_t pinDat, int32_t pinClk, int32_t mode, int32_t bits, int32_t value) {
  Io data = io_at(pinDat), clock = io_at(pinClk);
  io_drive(data, true);
  low(pinClk);
  for (uint8_t number = 0; number < bits; number++) {
    io_set(data, value >> (mode == LSBFIRST ? number : bits - 1 - number) & 1);
    clock_pulse(clock);
  }
}

// ---------------------------------------------------------------- two-wire bus

//# helper i2c_buses
//#   needs: simplei2c.h/i2c
//#   ram: 2
static i2c i2c_buses[2];

//# adapter i2c_newbus
//#   for: i2c *i2c_newbus(int sclPin, int sdaPin, int sclDrive)
//#   kind: manyToOne
//#   needs: i2c_buses simplei2c.h/BUS_SCL simplei2c.h/i2c simplei2c.h/i2c_open
//#   pin: sclPin digital both
//#   pin: sdaPin digital both
//#   fidelity: exact at the pins SCL and SDA; a bus at any other pins is not wired
//#   limit: the bus is the one of the hardware: connect devices to SCL and SDA
static inline i2c *i2c_newbus(int32_t sclPin, int32_t sdaPin, int32_t sclDrive) {
  return i2c_open(&i2c_buses[sclPin != BUS_SCL || sdaPin != BUS_SDA], sclPin, sdaPin, sclDrive);
}

//# helper i2c_begin
//#   needs: simplei2c.h/i2c simplei2c.h/i2c_start simplei2c.h/i2c_writeByte
//#   include: <stdlib.h>
//#   fidelity: addresses a device, then its memory: highest byte first, lowest first when the count is negative; counts acknowledged bytes
static inline int32_t i2c_begin(i2c *bus, int32_t address, int32_t memory, int32_t count) {
  i2c_start(bus);
  if (i2c_writeByte(bus, address << 1 & 0xFE)) return 0;
  int32_t taken = 0, size = labs(count);
  while (taken < size) {
    if (i2c_writeByte(bus, memory >> 8 * (count > 0 ? size - 1 - taken : taken) & 0xFF)) break;
    taken++;
  }
  return 1 + taken;
}

//# adapter i2c_out
//#   for: int i2c_out(i2c *busID, int i2cAddr, int memAddr, int memAddrCount, const unsigned char *data, int dataCount)
//#   kind: oneToMany
//#   needs: i2c_begin simplei2c.h/i2c simplei2c.h/i2c_writeByte simplei2c.h/i2c_stop
//#   include: <stdlib.h>
//#   fidelity: exact: the number of bytes that were acknowledged, with the device's address; 100 kHz
static inline int32_t i2c_out(i2c *busID, int32_t i2cAddr, int32_t memAddr, int32_t memAddrCount, const void *data, int32_t dataCount) {
  int32_t acknowledged = i2c_begin(busID, i2cAddr, memAddr, memAddrCount), size = labs(dataCount);
  if (!acknowledged) return 0;
  for (int32_t number = 0; number < size; number++, acknowledged++)
    if (i2c_writeByte(busID, ((const uint8_t *)data)[dataCount < 0 ? size - 1 - number : number])) break;
  i2c_stop(busID);
  return acknowledged;
}

//# adapter i2c_in
//#   for: int i2c_in(i2c *busID, int i2cAddr, int memAddr, int memAddrCount, unsigned char *data, int dataCount)
//#   kind: oneToMany
//#   needs: i2c_begin simplei2c.h/i2c simplei2c.h/i2c_start simplei2c.h/i2c_stop simplei2c.h/i2c_writeByte simplei2c.h/i2c_readByte
//#   include: <stdlib.h>
//#   fidelity: exact, with its count of bytes, which leaves out the last one read; 100 kHz
static inline int32_t i2c_in(i2c *busID, int32_t i2cAddr, int32_t memAddr, int32_t memAddrCount, void *data, int32_t dataCount) {
  int32_t acknowledged = i2c_begin(busID, i2cAddr, memAddr, memAddrCount), size = labs(dataCount);
  if (!acknowledged) return 0;
  i2c_start(busID);
  if (i2c_writeByte(busID, (i2cAddr << 1 & 0xFE) | 1)) return acknowledged;
  for (int32_t number = 0; number < size; number++)
    ((uint8_t *)data)[dataCount < 0 ? size - 1 - number : number] = i2c_readByte(busID, number == size - 1);
  i2c_stop(busID);
  return acknowledged + (size ? size : 1);
}

//# adapter i2c_busy
//#   for: int i2c_busy(i2c *busID, int i2cAddr)
//#   kind: oneToMany
//#   needs: simplei2c.h/i2c simplei2c.h/i2c_poll
//#   fidelity: exact: 0 when the device acknowledges its address, 1 when it does not
static inline int32_t i2c_busy(i2c *busID, int32_t i2cAddr) {
  return i2c_poll(busID, i2cAddr << 1 & 0xFE);
}

// ---------------------------------------------------------------- EEPROM of the microcontroller

//# helper ee_cell
//#   include: <avr/eeprom.h>
static inline uint8_t *ee_cell(int32_t addr) {
  return (uint8_t *)(uint16_t)((uint32_t)addr & E2END);
}

//# adapter ee_putByte
//#   for: void ee_putByte(unsigned char value, int addr)
//#   kind: oneToMany
//#   needs: ee_cell
//#   include: <avr/eeprom.h>
//#   fidelity: exact within the memory of the microcontroller
//#   limit: 1 KB instead of 64: addresses repeat every 1,024 bytes; what the source robot kept is not carried over
static inline void ee_putByte(uint8_t value, int32_t addr) {
  eeprom_update_byte(ee_cell(addr), value);
}

//# adapter ee_getByte
//#   for: char ee_getByte(int addr)
//#   kind: oneToMany
//#   needs: ee_cell
//#   include: <avr/eeprom.h>
//#   fidelity: exact within the memory of the microcontroller; 0 to 255
//#   limit: 1 KB instead of 64: addresses repeat every 1,024 bytes
static inline uint8_t ee_getByte(int32_t addr) {
  return eeprom_read_byte(ee_cell(addr));
}

//# adapter ee_putStr
//#   for: void ee_putStr(unsigned char *s, int n, int addr)
//#   kind: oneToMany
//#   needs: ee_putByte
//#   fidelity: exact within the memory of the microcontroller
//#   limit: 1 KB instead of 64: addresses repeat every 1,024 bytes
static inline void ee_putStr(const void *s, int32_t n, int32_t addr) {
  for (int32_t number = 0; number < n; number++) ee_putByte(((const uint8_t *)s)[number], addr + number);
}

//# adapter ee_getStr
//#   for: unsigned char *ee_getStr(unsigned char *s, int n, int addr)
//#   kind: oneToMany
//#   needs: ee_getByte
//#   fidelity: exact within the memory of the microcontroller
//#   limit: 1 KB instead of 64: addresses repeat every 1,024 bytes
static inline void *ee_getStr(void *s, int32_t n, int32_t addr) {
  for (int32_t number = 0; number < n; number++) ((uint8_t *)s)[number] = ee_getByte(addr + number);
  return s;
}

//# adapter ee_putInt
//#   for: void ee_putInt(int value, int addr)
//#   kind: oneToMany
//#   needs: ee_putStr
//#   fidelity: exact: four bytes, the lowest first
//#   limit: 1 KB instead of 64: addresses repeat every 1,024 bytes
static inline void ee_putInt(int32_t value, int32_t addr) {
  ee_putStr(&value, sizeof value, addr);
}

//# adapter ee_getInt
//#   for: int ee_getInt(int addr)
//#   kind: oneToMany
//#   needs: ee_getStr
//#   fidelity: exact: four bytes, the lowest first
//#   limit: 1 KB instead of 64: addresses repeat every 1,024 bytes
static inline int32_t ee_getInt(int32_t addr) {
  int32_t value;
  ee_getStr(&value, sizeof value, addr);
  return value;
}

//# adapter ee_putFloat32
//#   for: void ee_putFloat32(float value, int addr)
//#   kind: oneToMany
//#   needs: ee_putStr
//#   fidelity: exact
//#   limit: 1 KB instead of 64: addresses repeat every 1,024 bytes
static inline void ee_putFloat32(float value, int32_t addr) {
  ee_putStr(&value, sizeof value, addr);
}

//# adapter ee_getFloat32
//#   for: float ee_getFloat32(int addr)
//#   kind: oneToMany
//#   needs: ee_getStr
//#   fidelity: exact
//#   limit: 1 KB instead of 64: addresses repeat every 1,024 bytes
static inline float ee_getFloat32(int32_t addr) {
  float value;
  ee_getStr(&value, sizeof value, addr);
  return value;
}

//# adapter ee_config
//#   for: void ee_config(int sclPin, int sdaPin, int sclDrive)
//#   kind: oneToOne
//#   fidelity: nothing to do: the memory is inside of the microcontroller
//#   limit: an EEPROM at pins of its own is not used; call i2c_out and i2c_in for it
static inline void ee_config(int32_t sclPin, int32_t sdaPin, int32_t sclDrive) {
  (void)sclPin;
  (void)sdaPin;
  (void)sclDrive;
}

//# adapter ee_put_byte
//#   for: void ee_put_byte(unsigned char value, int addr)
//#   kind: oneToOne
//#   needs: ee_putByte
//#   fidelity: the older name of ee_putByte
//#   limit: 1 KB instead of 64: addresses repeat every 1,024 bytes
static inline void ee_put_byte(uint8_t value, int32_t addr) {
  ee_putByte(value, addr);
}

//# adapter ee_get_byte
//#   for: char ee_get_byte(int addr)
//#   kind: oneToOne
//#   needs: ee_getByte
//#   fidelity: the older name of ee_getByte
//#   limit: 1 KB instead of 64: addresses repeat every 1,024 bytes
static inline uint8_t ee_get_byte(int32_t addr) {
  return ee_getByte(addr);
}

//# adapter ee_put_int
//#   for: void ee_put_int(int value, int addr)
//#   kind: oneToOne
//#   needs: ee_putInt
//#   fidelity: the older name of ee_putInt
//#   limit: 1 KB instead of 64: addresses repeat every 1,024 bytes
static inline void ee_put_int(int32_t value, int32_t addr) {
  ee_putInt(value, addr);
}

//# adapter ee_get_int
//#   for: int ee_get_int(int addr)
//#   kind: oneToOne
//#   needs: ee_getInt
//#   fidelity: the older name of ee_getInt
//#   limit: 1 KB instead of 64: addresses repeat every 1,024 bytes
static inline int32_t ee_get_int(int32_t addr) {
  return ee_getInt(addr);
}

//# adapter ee_put_str
//#   for: void ee_put_str(unsigned char *s, int n, int addr)
//#   kind: oneToOne
//#   needs: ee_putStr
//#   fidelity: the older name of ee_putStr
//#   limit: 1 KB instead of 64: addresses repeat every 1,024 bytes
static inline void ee_put_str(const void *s, int32_t n, int32_t addr) {
  ee_putStr(s, n, addr);
}

//# adapter ee_get_str
//#   for: unsigned char *ee_get_str(unsigned char *s, int n, int addr)
//#   kind: oneToOne
//#   needs: ee_getStr
//#   fidelity: the older name of ee_getStr
//#   limit: 1 KB instead of 64: addresses repeat every 1,024 bytes
static inline void *ee_get_str(void *s, int32_t n, int32_t addr) {
  return ee_getStr(s, n, addr);
}

//# adapter ee_put_float32
//#   for: void ee_put_float32(float value, int addr)
//#   kind: oneToOne
//#   needs: ee_putFloat32
//#   fidelity: the older name of ee_putFloat32
//#   limit: 1 KB instead of 64: addresses repeat every 1,024 bytes
static inline void ee_put_float32(float value, int32_t addr) {
  ee_putFloat32(value, addr);
}

// ---------------------------------------------------------------- arithmetic

//# constant PI
//#   fidelity: exact
#define PI 3.141592653589793

//# adapter constrainInt
//#   for: int constrainInt(int value, int min, int max)
//#   kind: oneToOne
//#   symmetric: value lowest
//#   fidelity: exact: the middle one of the three, since the limits may come in either order
static inline int32_t constrainInt(int32_t value, int32_t lowest, int32_t highest) {
  if (lowest > highest) return constrainInt(value, highest, lowest);
  return value < lowest ? lowest : value > highest ? highest : value;
}

//# adapter constrainFloat
//#   for: float constrainFloat(float value, float min, float max)
//#   kind: oneToOne
//#   symmetric: value lowest
//#   fidelity: exact: the middle one of the three, since the limits may come in either order
static inline float constrainFloat(float value, float lowest, float highest) {
  if (lowest > highest) return constrainFloat(value, highest, lowest);
  return value < lowest ? lowest : value > highest ? highest : value;
}

//# adapter mapInt
//#   for: int mapInt(int value, int fromMin, int fromMax, int toMin, int toMax)
//#   kind: semantic
//#   include: <stdlib.h>
//#   fidelity: exact: to the nearest integer, halves away from zero, where map() cuts off
static inline int32_t mapInt(int32_t value, int32_t fromMin, int32_t fromMax, int32_t toMin, int32_t toMax) {
  int32_t product = (value - fromMin) * (toMax - toMin), range = fromMax - fromMin;
  int32_t steps = (labs(product) + labs(range) / 2) / labs(range);
  return (product < 0) == (range < 0) ? toMin + steps : toMin - steps;
}

//# adapter mapFloat
//#   for: float mapFloat(float value, float fromMin, float fromMax, float toMin, float toMax)
//#   kind: oneToOne
//#   fidelity: exact
static inline float mapFloat(float value, float fromMin, float fromMax, float toMin, float toMax) {
  return (value - fromMin) * (toMax - toMin) / (fromMax - fromMin) + toMin;
}

//# adapter endianSwap
//#   for: void endianSwap(void *resultAddr, void *varAddr, int byteCount)
//#   kind: oneToMany
//#   fidelity: exact
static inline void endianSwap(void *resultAddr, const void *varAddr, int32_t byteCount) {
  for (int32_t number = 0; number < byteCount; number++)
    ((uint8_t *)resultAddr)[number] = ((const uint8_t *)varAddr)[byteCount - 1 - number];
}

//# helper random_seeded
//#   ram: 1
static bool random_seeded = false;

//# adapter random
//#   for: int random(int limitLow, int limitHigh)
//#   kind: semantic
//#   name: random_between
//#   symmetric: limitLow limitHigh
//#   needs: random_seeded propeller.h/CNT stdlib.h/rand stdlib.h/srand
//#   include: <stdlib.h>
//#   fidelity: both limits inclusive, in either order; rand() behind it has 15 bits, as there
//#   limit: the first call seeds from the time alone: other numbers than there
static inline int32_t random_between(int32_t limitLow, int32_t limitHigh) {
  if (!random_seeded) c_srand(CNT);
  random_seeded = true;
  int32_t lower = limitLow < limitHigh ? limitLow : limitHigh, upper = limitLow < limitHigh ? limitHigh : limitLow;
  return lower + c_rand() % (upper + 1 - lower);
}

// ---------------------------------------------------------------- terminal

//# adapter term_cmd
//#   for: void term_cmd(int termConst, ...)
//#   kind: semantic
//#   needs: simpletext.h/simpleterm_pointer simpletext.h/writeByte simpletext.h/CRSRXY simpletext.h/CRSRX simpletext.h/CRSRY
//#   fidelity: exact: the command, and a column or a row behind CRSRX, CRSRY and CRSRXY
//#   limit: only a Parallax terminal obeys commands
static inline void term_bytes(const char *bytes) {
  uint8_t count = *bytes == CRSRXY ? 3 : *bytes == CRSRX || *bytes == CRSRY ? 2 : 1;
  while (count--) writeByte(simpleterm_pointer(), *bytes++);
}
#define term_cmd(...) term_bytes((const char[]){__VA_ARGS__, 0, 0})

// ---------------------------------------------------------------- counters of a cog, and the memory's address, as constants

//# constant EEPROM_ADDR
#define EEPROM_ADDR 0x50L

//# constant CTR_NCO
#define CTR_NCO 0x10000000L

//# constant NCO_PWM_1
#define NCO_PWM_1 0x10000000L

//# constant CTR_PLL
#define CTR_PLL 0x8000000L

//# constant DUTY_SE
#define DUTY_SE 0x18000000L
