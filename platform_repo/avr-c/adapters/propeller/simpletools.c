//# header simpletools.h
// Pins, time, pulses, shifting, EEPROM and arithmetic in C. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Utility/libsimpletools.
// A pin is AVR_PIN(port, bit) here; any other number is a port that is not wired, where nothing happens and 0 is read.

// ---------------------------------------------------------------- pins

//# helper Io
//#   include: <avr/interrupt.h>
//#   fidelity: OUTA and DIRA are independent on the Propeller and a released pin floats. PORT = 1 at an input of an AVR is a pull-up, so the
//#   fidelity: output latch is kept here, and reaches PORT only while the pin is an output.
//#   ram: 12
typedef struct {  // one pin, ready for access to its registers
  uint8_t number, mask;  // mask: 0 where there is no pin
  volatile uint8_t *in;  // PINx; DDRx and PORTx stand behind it
} Io;
enum { IO_DIRECTION = 1, IO_OUT = 2 };
static uint8_t io_latches[12];

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
  return io_driven(io_at(pin));
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
  io_drive(io, !io_driven(io));
  return io_driven(io);
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
  for (; last >= first; last--) pattern = pattern << 1 | io_driven(io_at(port(last)));
  return pattern;
}

//# adapter set_outputs
//#   for: void set_outputs(int endPin, int startPin, unsigned int pattern)
//#   kind: oneToMany
//#   symmetric: endPin startPin
//#   needs: Io propeller.h/port
//#   fidelity: output latches; the pins change one after the other, within some 5 us each
static inline void set_outputs(int32_t endPin, int32_t startPin, uint32_t pattern) {
  int32_t first = endPin < startPin ? endPin : startPin, last = endPin < startPin ? startPin : endPin;
  for (; first <= last; first++, pattern >>= 1) io_set(io_at(port(first)), pattern & 1);
}

//# adapter set_directions
//#   for: void set_directions(int endPin, int startPin, unsigned int pattern)
//#   kind: oneToMany
//#   symmetric: endPin startPin
//#   needs: Io propeller.h/port
//#   fidelity: directions; the pins change one after the other, within some 5 us each
static inline void set_directions(int32_t endPin, int32_t startPin, uint32_t pattern) {
  int32_t first = endPin < startPin ? endPin : startPin, last = endPin < startPin ? startPin : endPin;
  for (; first <= last; first++, pattern >>= 1) io_drive(io_at(port(first)), pattern & 1);
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

//# adapter pulse_in
//#   for: int pulse_in(int pin, int state)
//#   kind: oneToMany
//#   needs: Io propeller.h/clock_us leaves in_units io_timeout_ticks
//#   pin: pin digital in
//#   fidelity: within 2 us; 0 when no pulse begins in time, the part seen when it does not end
//#   limit: an edge within an interrupt is known to half of its time: 12 us beside servos, up to 22 us where interrupts meet
//#   limit: other cogs wait meanwhile
static inline int32_t pulse_in(int32_t pin, int32_t state) {
  Io io = io_at(pin);
  if (!io.mask) return 0;
  io_drive(io, false);
  uint8_t level = state ? io.mask : 0, other = io.mask ^ level;
  uint32_t limit = (uint32_t)io_timeout_ticks / 80, begun = clock_us(), from, to;
  if (!leaves(io, level, begun, limit, &from) || !leaves(io, other, begun, limit, &from)) return 0;
  leaves(io, level, begun, limit, &to);
  return in_units(to - from);
}

//# adapter rc_time
//#   for: long rc_time(int pin, int state)
//#   kind: oneToMany
//#   needs: Io propeller.h/clock_us leaves edge_cycles in_units io_timeout_ticks
//#   pin: pin digital in
//#   fidelity: within 2 us
//#   limit: an edge within an interrupt is known to half of its time: 12 us beside servos, up to 22 us where interrupts meet
//#   limit: at 5 V a decay takes some 15 to 20 % longer than at 3.3 V: check the program's limits
//#   limit: other cogs wait meanwhile
static inline int32_t rc_time(int32_t pin, int32_t state) {
  Io io = io_at(pin);
  if (!io.mask) return 0;
  uint8_t old = SREG;
  cli();
  io_drive(io, false);
  uint32_t from = edge_cycles(), begun = clock_us(), to;
  SREG = old;
  leaves(io, state ? io.mask : 0, begun, (uint32_t)io_timeout_ticks / 80, &to);
  return in_units(to - from);
}

//# adapter pulse_out
//#   for: void pulse_out(int pin, int time)
//#   kind: oneToMany
//#   needs: Io io_ticks propeller.h/clock_us
//#   include: <avr/interrupt.h> <util/delay_basic.h>
//#   pin: pin digital out
//#   fidelity: within 0.5 us or 1 %; the pulse is the inverse of the output latch
static inline void pulse_delay(uint16_t width) {  // microseconds, less what stands around the call
  uint16_t turns = width * (uint16_t)(F_CPU / 4000000UL);
  if (turns > 3) _delay_loop_2(turns - 3);
}

static inline void pulse_out(int32_t pin, int32_t time) {
  Io io = io_at(pin);
  if (!io.mask) return;
  uint32_t width = io_ticks == 80 ? (uint32_t)time : (uint32_t)time * io_ticks / 80;
  io_drive(io, true);
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

//# adapter count
//#   for: long count(int pin, long duration)
//#   kind: semantic
//#   needs: Io propeller.h/clock_us propeller.h/clock_wait
//#   pin: pin digital in
//#   fidelity: rising edges in so many milliseconds
//#   limit: it polls: up to about 100 kHz
static inline int32_t count(int32_t pin, int32_t duration) {
  Io io = io_at(pin);
  if (!io.mask) {
    clock_wait(duration);
    return 0;
  }
  io_drive(io, false);
  int32_t edges = 0;
  uint8_t last = *io.in & io.mask;
  for (uint32_t begun = clock_us(); clock_us() - begun < (uint32_t)duration * 1000;)
    for (uint8_t turn = 50; turn; turn--) {
      uint8_t now = *io.in & io.mask;
      edges += now && !last;
      last = now;
    }
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
//#   limit: one tone at a time; below 31 Hz and above 65,535 Hz it waits without a tone
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
//#   needs: random_seeded propeller.h/CNT
//#   include: <stdlib.h>
//#   fidelity: both limits inclusive, in either order; rand() behind it has 15 bits, as there
//#   limit: the first call seeds from the time alone: other numbers than there
static inline int32_t random_between(int32_t limitLow, int32_t limitHigh) {
  if (!random_seeded) srand((unsigned int)CNT);
  random_seeded = true;
  int32_t lower = limitLow < limitHigh ? limitLow : limitHigh, upper = limitLow < limitHigh ? limitHigh : limitLow;
  return lower + rand() % (upper + 1 - lower);
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
