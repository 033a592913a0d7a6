//# header simpletools.h
// Pins, time, pulses, shifting, EEPROM and arithmetic. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Utility/libsimpletools.
// A pin is one of the target here; any other number is a port that is not wired, where nothing happens and 0 is read.

// ---------------------------------------------------------------- pins
// A call whose pin the compiler knows becomes some instructions. In any other the pin is looked up, by a function that such calls share.

//# helper drive_level
//#   needs: hal/Io
inline void drive_level(int32_t pin, bool value) {
  Io(pin).level(value);
}

//# adapter high
//#   for: void high(int pin)
//#   kind: oneToMany
//#   needs: drive_level hal/KnownIo
//#   pin: pin digital out
//#   fidelity: exact
//#   stack: 12 2
__attribute__((always_inline)) inline void high(int32_t pin) {
  if (pin_is_known(pin)) KnownIo(pin).level(true);
  else drive_level(pin, true);
}

//# adapter low
//#   for: void low(int pin)
//#   kind: oneToMany
//#   needs: drive_level hal/KnownIo
//#   pin: pin digital out
//#   fidelity: exact
//#   stack: 12 2
__attribute__((always_inline)) inline void low(int32_t pin) {
  if (pin_is_known(pin)) KnownIo(pin).level(false);
  else drive_level(pin, false);
}

//# adapter get_state
//#   for: unsigned int get_state(int pin)
//#   kind: oneToOne
//#   needs: hal/Io hal/KnownIo
//#   pin: pin digital in
//#   fidelity: exact
//#   stack: 2 0
inline uint32_t get_state_at(int32_t pin) {
  return Io(pin).high();
}

__attribute__((always_inline)) inline uint32_t get_state(int32_t pin) {
  if (!pin_is_known(pin)) return get_state_at(pin);
  return KnownIo(pin).high();
}

//# adapter input
//#   for: unsigned int input(int pin)
//#   kind: oneToMany
//#   needs: hal/Io hal/KnownIo
//#   pin: pin digital in
//#   fidelity: exact; the output latch is kept
//#   stack: 4 0
inline uint32_t input_at(int32_t pin) {
  Io io(pin);
  io.drive(false);
  return io.high();
}

__attribute__((always_inline)) inline uint32_t input(int32_t pin) {
  if (!pin_is_known(pin)) return input_at(pin);
  KnownIo io(pin);
  io.drive(false);
  return io.high();
}

//# adapter get_output
//#   for: unsigned int get_output(int pin)
//#   kind: semantic
//#   needs: hal/Io hal/KnownIo
//#   pin: pin digital both
//#   fidelity: the latch of the whole program; on the Propeller each cog has one of its own
//#   stack: 14 0
inline uint32_t get_output_at(int32_t pin) {
  return Io(pin).latch();
}

__attribute__((always_inline)) inline uint32_t get_output(int32_t pin) {
  if (!pin_is_known(pin)) return get_output_at(pin);
  return KnownIo(pin).latch();
}

//# adapter get_direction
//#   for: unsigned int get_direction(int pin)
//#   kind: oneToOne
//#   needs: hal/Io hal/KnownIo hal/own_pins
//#   pin: pin digital both
//#   fidelity: exact; where the target has no cogs, for a program on one cog
//#   stack: 4 0
inline uint32_t get_direction_at(int32_t pin) {
  return owned(Io(pin));
}

__attribute__((always_inline)) inline uint32_t get_direction(int32_t pin) {
  if (!pin_is_known(pin)) return get_direction_at(pin);
  return owned(KnownIo(pin));
}

//# adapter set_output
//#   for: void set_output(int pin, int state)
//#   kind: semantic
//#   needs: hal/Io hal/KnownIo
//#   pin: pin digital out
//#   fidelity: exact
//#   stack: 5 0
inline void set_output_at(int32_t pin, bool state) {
  Io(pin).set(state);
}

__attribute__((always_inline)) inline void set_output(int32_t pin, int32_t state) {
  if (pin_is_known(pin)) KnownIo(pin).set(state != 0);
  else set_output_at(pin, state != 0);
}

//# adapter set_direction
//#   for: void set_direction(int pin, int direction)
//#   kind: semantic
//#   needs: hal/Io hal/KnownIo
//#   pin: pin digital both
//#   fidelity: exact
//#   stack: 4 0
inline void set_direction_at(int32_t pin, bool direction) {
  Io(pin).drive(direction);
}

__attribute__((always_inline)) inline void set_direction(int32_t pin, int32_t direction) {
  if (pin_is_known(pin)) KnownIo(pin).drive(direction != 0);
  else set_direction_at(pin, direction != 0);
}

//# adapter toggle
//#   for: unsigned int toggle(int pin)
//#   kind: oneToMany
//#   needs: hal/Io hal/KnownIo
//#   pin: pin digital out
//#   fidelity: exact: the latch is inverted and the pin becomes an output
//#   stack: 16 14
inline uint32_t toggle_at(int32_t pin) {
  Io io(pin);
  io.set(!io.latch());
  io.drive(true);
  return io.latch();
}

__attribute__((always_inline)) inline uint32_t toggle(int32_t pin) {
  if (!pin_is_known(pin)) return toggle_at(pin);
  KnownIo io(pin);
  io.set(!io.latch());
  io.drive(true);
  return io.latch();
}

//# adapter reverse
//#   for: unsigned int reverse(int pin)
//#   kind: oneToMany
//#   needs: hal/Io hal/KnownIo hal/own_pins
//#   pin: pin digital both
//#   fidelity: exact
//#   stack: 14 2
inline uint32_t reverse_at(int32_t pin) {
  Io io(pin);
  io.drive(!owned(io));
  return owned(io);
}

__attribute__((always_inline)) inline uint32_t reverse(int32_t pin) {
  if (!pin_is_known(pin)) return reverse_at(pin);
  KnownIo io(pin);
  io.drive(!owned(io));
  return owned(io);
}

// ---------------------------------------------------------------- several pins
// Ends of a range are ports of the source: what lies between them is in its order, not in that of the target's pins.

//# helper PortRange
//#   fidelity: the ends may come in either order; bit 0 of a pattern is the lower port
struct PortRange {
  int32_t first, last;

  PortRange(int32_t end, int32_t start) : first(end < start ? end : start), last(end < start ? start : end) {}
};

//# adapter get_states
//#   for: unsigned int get_states(int endPin, int startPin)
//#   kind: oneToMany
//#   symmetric: endPin startPin
//#   needs: hal/Io PortRange propeller.h/port
//#   fidelity: levels; the pins are read one after the other, within some 5 us each
//#   stack: 16 0
inline uint32_t get_states(int32_t endPin, int32_t startPin) {
  PortRange range(endPin, startPin);
  uint32_t pattern = 0;
  for (int32_t number = range.last; number >= range.first; number--) pattern = pattern << 1 | Io(port(number)).high();
  return pattern;
}

//# adapter get_outputs
//#   for: unsigned int get_outputs(int endPin, int startPin)
//#   kind: oneToMany
//#   symmetric: endPin startPin
//#   needs: hal/Io PortRange propeller.h/port
//#   fidelity: output latches; the pins are read one after the other, within some 5 us each
//#   stack: 14 0
inline uint32_t get_outputs(int32_t endPin, int32_t startPin) {
  PortRange range(endPin, startPin);
  uint32_t pattern = 0;
  for (int32_t number = range.last; number >= range.first; number--) pattern = pattern << 1 | Io(port(number)).latch();
  return pattern;
}

//# adapter get_directions
//#   for: unsigned int get_directions(int endPin, int startPin)
//#   kind: oneToMany
//#   symmetric: endPin startPin
//#   needs: hal/Io hal/own_pins PortRange propeller.h/port
//#   fidelity: directions; the pins are read one after the other, within some 5 us each
//#   stack: 16 0
inline uint32_t get_directions(int32_t endPin, int32_t startPin) {
  PortRange range(endPin, startPin);
  uint32_t pattern = 0;
  for (int32_t number = range.last; number >= range.first; number--) pattern = pattern << 1 | owned(Io(port(number)));
  return pattern;
}

//# adapter set_outputs
//#   for: void set_outputs(int endPin, int startPin, unsigned int pattern)
//#   kind: oneToMany
//#   symmetric: endPin startPin
//#   needs: hal/Io PortRange propeller.h/port
//#   fidelity: output latches; the pins change one after the other, within some 5 us each; what a pattern has beyond its ports sets those that follow
//#   stack: 22 0
inline void set_outputs(int32_t endPin, int32_t startPin, uint32_t pattern) {
  PortRange range(endPin, startPin);
  for (int32_t number = range.first; number <= range.last || (pattern && number < 32); number++, pattern >>= 1)
    if (number <= range.last || pattern & 1) Io(port(number)).set(pattern & 1);
}

//# adapter set_directions
//#   for: void set_directions(int endPin, int startPin, unsigned int pattern)
//#   kind: oneToMany
//#   symmetric: endPin startPin
//#   needs: hal/Io PortRange propeller.h/port
//#   fidelity: directions; the pins change one after the other, within some 5 us each; what a pattern has beyond its ports sets those that follow
//#   stack: 22 0
inline void set_directions(int32_t endPin, int32_t startPin, uint32_t pattern) {
  PortRange range(endPin, startPin);
  for (int32_t number = range.first; number <= range.last || (pattern && number < 32); number++, pattern >>= 1)
    if (number <= range.last || pattern & 1) Io(port(number)).drive(pattern & 1);
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
//#   stack: 0
const int32_t ms = 80000L;

//# variable us
//#   fidelity: exact: ticks in a microsecond, no time
//#   stack: 0
const int32_t us = 80L;

//# adapter pause
//#   for: void pause(int time)
//#   kind: oneToOne
//#   needs: pause_unit propeller.h/wait_until propeller.h/CNT
//#   fidelity: within 0.1 %
//#   stack: 12 2
inline void pause(int32_t time) {
  if (pause_unit == 80000L) {
    delay((uint32_t)time);
    return;
  }
  for (uint32_t at = CNT; time > 0; time--) wait_until(at += pause_unit);
}

//# adapter pause
//#   for: void pause(int time)
//#   beside: cog_run cog_runStackTest cogstart cogstart_stackTest pthread_create
//#   kind: oneToOne
//#   needs: pause_unit propeller.h/wait_until propeller.h/CNT propeller.h/held_up
//#   fidelity: within 0.1 % in the mean: what other cogs make a pause longer is taken off the next ones, up to half of each
//#   limit: where cogs take turns, it may end later: the others first run until they wait (see RS325)
//#   stack: 12 2
inline void pause(int32_t time) {
  if (pause_unit != 80000L) {
    for (uint32_t at = CNT; time > 0; time--) wait_until(at += pause_unit);
    return;
  }
  uint32_t asked = time, less = held_up / 1000, begun = micros();
  if (less > asked / 2) less = asked / 2;
  delay(asked - less);
  held_up += micros() - begun - 1000 * asked;  // modulo 2^32, as all three are
  if (asked && held_up / 1000 > asked) held_up = 1000 * asked;  // what is longer than the pause is lost
}

//# adapter set_pause_dt
//#   for: void set_pause_dt(int clockticks)
//#   kind: oneToOne
//#   needs: pause_unit
//#   fidelity: exact
//#   stack: 0
inline void set_pause_dt(int32_t clockticks) {
  pause_unit = clockticks;
}

//# adapter set_io_dt
//#   for: void set_io_dt(int clockticks)
//#   kind: oneToOne
//#   needs: io_ticks
//#   fidelity: exact
//#   stack: 0
inline void set_io_dt(int32_t clockticks) {
  io_ticks = clockticks;
}

//# adapter set_io_timeout
//#   for: void set_io_timeout(int clockticks)
//#   kind: oneToOne
//#   needs: io_timeout_ticks
//#   fidelity: exact
//#   stack: 0
inline void set_io_timeout(int32_t clockticks) {
  io_timeout_ticks = clockticks;
}

//# adapter pause_ticks
//#   for: void pause_ticks(unsigned int pticks)
//#   kind: oneToMany
//#   needs: propeller.h/wait_until propeller.h/CNT
//#   fidelity: within 8 us
//#   stack: 4
inline void pause_ticks(uint32_t pticks) {
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
//#   stack: 2 0
inline void mark() {
  mark_ticks = CNT;
}

//# adapter timeout
//#   for: int timeout(int time)
//#   kind: semantic
//#   needs: mark_ticks io_ticks propeller.h/CNT
//#   fidelity: within 8 us; up to 53.7 s after mark, as there
//#   stack: 14 0
inline int32_t timeout(int32_t time) {
  return CNT - mark_ticks >= (uint32_t)time * (uint32_t)io_ticks;
}

//# adapter wait
//#   for: void wait(int time)
//#   kind: semantic
//#   needs: mark_ticks io_ticks propeller.h/waitcnt
//#   fidelity: within 8 us, without drift: each wait begins where the one before it ended
//#   stack: 10 4
inline void wait(int32_t time) {
  waitcnt(mark_ticks += (uint32_t)time * (uint32_t)io_ticks);
}

// ---------------------------------------------------------------- timed input and output

//# helper TimedInput
//#   fidelity: what drives and servos calculate every 20 ms waits while an input is timed: up to 20 ms for the edge that begins it, and
//#   fidelity: up to 20 ms for the one that ends it
//#   ram: 3
static volatile uint8_t frames_wait;  // for how many periods of 1,024 us frame jobs wait
static void (*frames_due)();          // does those that have waited

struct TimedInput {
  TimedInput() { edge_found(); }
  ~TimedInput() {
    frames_wait = 0;
    if (frames_due) frames_due();
  }
  void edge_found() { frames_wait = 20; }
};

//# helper in_units
//#   needs: io_ticks
inline int32_t in_units(uint32_t sixteenths) {  // of a microsecond
  uint32_t micros_ = (sixteenths + 8) / 16;
  return io_ticks == 80 ? micros_ : micros_ * 80 / io_ticks;
}

//# helper asking
//#   fidelity: the pin that asks and the one that answers, of a component with a wire for each direction; else the pin itself is both
inline int32_t asking(int32_t pin) {
#ifdef SPLIT_WIRES
  for (const auto &wires : split_wires)
    if (wires.answers == pin) return wires.asks;
#endif
  return pin;
}

inline int32_t answering(int32_t pin) {
#ifdef SPLIT_WIRES
  for (const auto &wires : split_wires)
    if (wires.asks == pin || wires.answers == pin) return wires.answers;
#endif
  return pin;
}

//# adapter pulse_in
//#   for: int pulse_in(int pin, int state)
//#   kind: oneToMany
//#   needs: hal/Io hal/leaves TimedInput in_units io_timeout_ticks
//#   pin: pin digital in
//#   fidelity: within 2 us; 0 when no pulse begins in time, the part seen when it does not end
//#   limit: the time of an edge during an interrupt is wrong by up to 12 us beside servos, 22 us where interrupts meet, 32 us with feedback
//#   limit: other cogs wait meanwhile
//#   stack: 63 47
inline int32_t pulse_in(int32_t pin, int32_t state) {
  Io io(pin);
  if (!io.wired()) return 0;
  io.drive(false);
  TimedInput timed;
  bool high = state;
  uint32_t limit = (uint32_t)io_timeout_ticks / 80, begun = micros(), from, to;
  if (!leaves(io, high, begun, limit, from) || !leaves(io, !high, begun, limit, from)) return 0;
  timed.edge_found();
  leaves(io, high, begun, limit, to);
  return in_units(to - from);
}

//# adapter rc_time
//#   for: long rc_time(int pin, int state)
//#   kind: oneToMany
//#   needs: hal/Io hal/Uninterrupted hal/edge_clock hal/leaves TimedInput in_units io_timeout_ticks
//#   pin: pin digital in
//#   fidelity: within 2 us
//#   limit: the time of an edge during an interrupt is wrong by up to 12 us beside servos, 22 us where interrupts meet, 32 us with feedback
//#   limit avr: at 5 V a decay takes some 15 to 20 % longer than at 3.3 V: check the program's limits
//#   limit: other cogs wait meanwhile
//#   stack: 54 42
inline int32_t rc_time(int32_t pin, int32_t state) {
  Io io(pin);
  if (!io.wired()) return 0;
  TimedInput timed;
  uint32_t from, begun, to;
  {
    Uninterrupted now;
    io.drive(false);
    from = edge_clock();
    begun = micros();
  }
  leaves(io, state, begun, (uint32_t)io_timeout_ticks / 80, to);
  return in_units(to - from);
}

//# adapter pulse_out
//#   for: void pulse_out(int pin, int time)
//#   kind: oneToMany
//#   needs: hal/Io hal/KnownIo hal/pulse io_ticks TimedInput
//#   pin: pin digital out
//#   fidelity: within 0.5 us or 1 %; the pulse is the inverse of the output latch
//#   stack: 28 20
template <class Pin> inline void timed_pulse(Pin io, int32_t time) {
  uint32_t width = io_ticks == 80 ? (uint32_t)time : (uint32_t)time * io_ticks / 80;
  if (frames_due) frames_due();
  frames_wait = 20;
  pulse(io, width);
  frames_wait = 3;  // what answers to the pulse may be timed next
}

inline void pulse_out_at(int32_t pin, int32_t time) {
  Io io(pin);
  if (!io.wired()) return;
  io.drive(true);
  timed_pulse(io, time);
}

__attribute__((always_inline)) inline void pulse_out(int32_t pin, int32_t time) {
  if (!pin_is_known(pin)) return pulse_out_at(pin, time);
  KnownIo io(pin);
  if (!io.wired()) return;
  io.drive(true);
  timed_pulse(io, time);
}

//# helper wave_pins
//#   fidelity: the pin of each channel of square_wave
//#   ram: 8
static int32_t wave_pins[2] = {-1, -1};

//# adapter count
//#   for: long count(int pin, long duration)
//#   kind: semantic
//#   needs: hal/Io hal/PinInput TimedInput wave_pins
//#   pin: pin digital in
//#   fidelity: rising edges in so many milliseconds, of a wave of square_wave, too
//#   limit: it polls: up to about 200 kHz, beside servos 20 kHz, as edges within an interrupt are not counted; other cogs wait meanwhile
//#   stack: 37 16
inline int32_t count(int32_t pin, int32_t duration) {
  Io io(pin);
  if (!io.wired()) {
    delay((uint32_t)duration);
    return 0;
  }
  if (pin != wave_pins[0] && pin != wave_pins[1]) io.drive(false);
  TimedInput timed;
  int32_t edges = 0;
  PinInput input = input_of(io);
  bool last = input.high();
  for (uint16_t second; duration > 0; duration -= second) {
    second = duration < 1000 ? duration : 1000;
    for (uint32_t begun = micros(); micros() - begun < second * 1000UL;) {
      for (uint8_t turn = 8; turn; turn--) {
        bool now = input.high();
        edges += now && !last;
        last = now;
      }
      if (frames_wait > 1) continue;
      uint32_t stopped = micros();  // what has waited takes its time now, which does not count
      if (frames_due) frames_due();
      timed.edge_found();
      last = input.high();
      begun += micros() - stopped;
    }
  }
  return edges;
}

//# helper in_range_of_tone
//#   fidelity: what tone() can play within 1 %
inline bool in_range_of_tone(int32_t frequency) {
  return frequency >= 31 && frequency <= 65535L;
}

//# adapter freqout
//#   for: void freqout(int pin, int msTime, int frequency)
//#   kind: oneToMany
//#   needs: hal/Io hal/tones low in_range_of_tone
//#   pin: pin digital out
//#   fidelity: 1 % in frequency from 31 Hz up to 65 kHz; the burst ends with the call and the pin as an input
//#   limit: one tone at a time; no tone below 31 Hz and above 65,535 Hz, where it only waits
//#   limit: beside servos some half periods are up to 24 us longer: a burst of 1 ms at 38 kHz may be one cycle short
//#   range: frequency 31..65535 or 0: it waits without a tone
//#   stack: 50 28
//#   interrupt: TIMER2_COMPA_vect 19
inline void freqout(int32_t pin, int32_t msTime, int32_t frequency) {
  Io io(pin);
  if (!io.wired() || !in_range_of_tone(frequency)) {
    delay((uint32_t)msTime);
    return;
  }
  low(pin);
  begin_tone(io, frequency);
  delay((uint32_t)msTime);
  end_tone(io);
  io.drive(false);
}

// ---------------------------------------------------------------- waves that go on

//# helper end_wave
//#   needs: hal/Io hal/slow_wave hal/tones wave_pins
inline void end_wave(uint8_t channel) {
  Io io(wave_pins[channel]);
  wave_pins[channel] = -1;
  if (!io.wired()) return;
  if (slow_wave_runs()) end_slow_wave();
  else end_tone(io);
  io.drive(false);
}

//# adapter square_wave
//#   for: void square_wave(int pin, int channel, int freq)
//#   kind: semantic
//#   needs: hal/Io hal/slow_wave hal/tones wave_pins end_wave in_range_of_tone low
//#   pin: pin digital out signed
//#   fidelity: 1 % in frequency up to 65 kHz; a negative pin ends the channel's wave
//#   limit: one wave at a time: while one channel plays, the other stays silent
//#   limit: below 31 Hz a wave stands still from the next freqout on
//#   limit: above 65,535 Hz there is no wave
//#   range: freq 0..65535: there is no wave
//#   stack: 47 20
//#   interrupt: TIMER2_COMPA_vect 19
//#   interrupt: TIMER2_COMPB_vect 11
inline void square_wave(int32_t pin, int32_t channel, int32_t freq) {
  uint8_t at = channel != 0;
  bool slow = freq > 0 && freq < 31, wave = slow || in_range_of_tone(freq);
  if (pin != wave_pins[at] || !wave || slow != slow_wave_runs()) end_wave(at);
  Io io(pin);
  if (!io.wired() || !wave || wave_pins[!at] >= 0) return;
  bool begins = wave_pins[at] != pin;
  wave_pins[at] = pin;
  if (!slow) {
    begin_tone(io, freq);
    return;
  }
  if (begins) low(pin);
  begin_slow_wave(io, freq);
}

//# adapter square_wave_stop
//#   for: void square_wave_stop(void)
//#   kind: semantic
//#   needs: end_wave
//#   fidelity: exact; the pins become inputs
//#   stack: 14
//#   interrupt: TIMER2_COMPA_vect 19
//#   interrupt: TIMER2_COMPB_vect 11
inline void square_wave_stop() {
  end_wave(0);
  end_wave(1);
}

//# adapter pwm_set
//#   for: void pwm_set(int pin, int channel, int tHigh)
//#   kind: semantic
//#   needs: hal/Io hal/pwm_pair
//#   pin: pin digital out
//#   fidelity: within 4 us, from the next cycle on
//#   limit: pulses shorter than 8 us come out up to 8 us long
//#   range: tHigh 8.. or 0: the pulse comes out up to 8 us long
//#   stack: 38 24
//#   interrupt: TIMER1_COMPA_vect 19
//#   interrupt: TIMER1_COMPB_vect 19
inline void pwm_set(int32_t pin, int32_t channel, int32_t tHigh) {
  set_pwm_pair(channel != 0, Io(pin), tHigh < 0 ? 0 : tHigh);
}

//# adapter pwm_start
//#   for: int pwm_start(unsigned int cycleMicroseconds)
//#   kind: semantic
//#   needs: hal/pwm_pair
//#   fidelity: within 0.1 %; the number returned is not that of a cog
//#   limit: cycles of more than 262 ms are made 262 ms long
//#   limit avr: not together with servos, which need Timer1, too
//#   range: cycleMicroseconds 20..262144: the cycle is made 262 ms or 20 us long
//#   stack: 8 0
//#   interrupt: TIMER1_COMPA_vect 19
//#   interrupt: TIMER1_COMPB_vect 19
inline int32_t pwm_start(uint32_t cycleMicroseconds) {
  begin_pwm_pair(cycleMicroseconds > 262144UL ? 262144UL : cycleMicroseconds < 20 ? 20 : cycleMicroseconds);
  return 2;
}

//# adapter pwm_stop
//#   for: void pwm_stop(void)
//#   kind: semantic
//#   needs: hal/pwm_pair
//#   fidelity: exact: no more pulses, and the pins become inputs
//#   stack: 4 0
//#   interrupt: TIMER1_COMPA_vect 19
//#   interrupt: TIMER1_COMPB_vect 19
inline void pwm_stop() {
  end_pwm_pair();
}

//# helper dac_pins
//#   fidelity: the pin of each channel of dac_ctr
//#   ram: 4
static int16_t dac_pins[2] = {-1, -1};

//# helper dac_bits
//#   fidelity: resolution of dac_ctr
//#   ram: 1
static uint8_t dac_bits = 8;

//# helper end_dac
//#   needs: hal/Io dac_pins
inline void end_dac(uint8_t channel) {
  Io io(dac_pins[channel]);
  dac_pins[channel] = -1;
  if (!io.wired()) return;
  digitalWrite(io.pin, LOW);  // which ends the wave of its timer
  io.drive(false);
}

//# adapter dac_ctr
//#   for: void dac_ctr(int pin, int channel, int dacVal)
//#   kind: semantic
//#   needs: hal/Io hal/KnownIo dac_pins dac_bits end_dac
//#   setup rp2040: analogWriteFreq(20000);
//#   pin: pin pwm out
//#   fidelity avr: the mean voltage within 0.4 % of the supply, which is 5 V here and 3.3 V there
//#   fidelity other: the mean voltage within 0.4 % of the supply
//#   limit avr: 490 or 980 Hz instead of megahertz: a filter needs a hundred to a thousand times the capacity
//#   limit rp2040: 20 kHz instead of megahertz: a filter needs up to fifty times the capacity
//#   limit other: 1 kHz instead of megahertz: a filter needs a hundred to a thousand times the capacity
//#   limit: 8 bits: further bits of the resolution are left out
//#   stack: 23 14
inline void dac_ctr_at(int16_t pin, uint8_t at, int32_t dacVal) {
  if (pin != dac_pins[at]) {
    end_dac(at);
    if (Io(pin).wired()) dac_pins[at] = pin;
  }
  if (dac_pins[at] < 0) return;
  if (dac_bits != 8) dacVal = (uint32_t)dacVal << (32 - dac_bits) >> 24;
  analogWrite(pin, (uint8_t)dacVal);  // what does not fit is lost, as there
}

__attribute__((always_inline)) inline void dac_ctr(int32_t pin, int32_t channel, int32_t dacVal) {
  uint8_t at = channel != 0;
  int16_t number = pin < 0 || pin > 255 ? -1 : pin;
  if (pin_is_known(pin) && number >= 0 && dac_pins[at] == number && dac_bits == 8) analogWrite(number, (uint8_t)dacVal);
  else dac_ctr_at(number, at, dacVal);
}

//# adapter dac_ctr_res
//#   for: void dac_ctr_res(int bits)
//#   kind: oneToOne
//#   needs: dac_bits
//#   fidelity: exact; 0 means 8 bits
//#   range: bits 1..8: further bits are left out
//#   stack: 0
inline void dac_ctr_res(int32_t bits) {
  dac_bits = bits > 0 && bits <= 32 ? bits : 8;
}

//# adapter dac_ctr_stop
//#   for: void dac_ctr_stop(void)
//#   kind: semantic
//#   needs: end_dac
//#   fidelity: exact; the pins become inputs
//#   stack: 6
inline void dac_ctr_stop() {
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
//#   fidelity: the target has it, with the same value
static_assert(LSBFIRST == 0, "LSBFIRST is 0 in simpletools.h");

//# constant MSBFIRST
//#   fidelity: the target has it, with the same value
static_assert(MSBFIRST == 1, "MSBFIRST is 1 in simpletools.h");

//# helper clock_pulse
//#   needs: hal/Io hal/pulse
inline void clock_pulse(const Io &clock) {
  if (clock.wired()) pulse(clock, 4);  // a part may need more than a microsecond until its next bit stands
}

//# adapter shift_in
//#   for: int shift_in(int pinDat, int pinClk, int mode, int bits)
//#   kind: semantic
//#   needs: hal/Io clock_pulse MSBPRE LSBPRE MSBPOST
//#   pin: pinDat digital in
//#   pin: pinClk digital out
//#   fidelity: exact but for the clock, which is some 200 kHz on an AVR
//#   stack: 48 24
inline int32_t shift_in(int32_t pinDat, int32_t pinClk, int32_t mode, int32_t bits) {
  bool before = mode == MSBPRE || mode == LSBPRE, highest = mode == MSBPRE || mode == MSBPOST;
  Io data(pinDat), clock(pinClk);
  uint32_t value = 0, bit = 1;
  data.drive(false);
  clock.level(false);
  for (uint8_t number = 0; number < bits; number++) {
    if (!before) clock_pulse(clock);
    if (highest) value <<= 1;
    if (data.high()) value |= bit;
    if (!highest) bit <<= 1;
    if (before) clock_pulse(clock);
  }
  return (int32_t)value;
}

//# adapter shift_out
//#   for: void shift_out(int pinDat, int pinClk, int mode, int bits, int value)
//#   kind: semantic
//#   needs: hal/Io clock_pulse
//#   pin: pinDat digital out
//#   pin: pinClk digital out
//#   fidelity: exact but for the clock, which is some 100 kHz on an AVR
//#   stack: 52 24
inline void shift_out(int32_t pinDat, int32_t pinClk, int32_t mode, int32_t bits, int32_t value) {
  Io data(pinDat), clock(pinClk);
  bool lowest = mode == LSBFIRST;
  uint32_t rest = lowest ? value : (uint32_t)value << (uint8_t)(32 - bits);
  data.drive(true);
  clock.level(false);
  for (uint8_t left = bits > 0 ? bits : 0; left; left--) {
    data.set(lowest ? rest & 1 : rest >> 31);
    rest = lowest ? rest >> 1 : rest << 1;
    clock_pulse(clock);
  }
}

// ---------------------------------------------------------------- two-wire bus

//# constant EEPROM_ADDR
#define EEPROM_ADDR 0x50L

//# helper i2c_buses
//#   needs: simplei2c.h/i2c
//#   ram: 2
static i2c i2c_buses[2];

//# adapter i2c_newbus
//#   for: i2c *i2c_newbus(int sclPin, int sdaPin, int sclDrive)
//#   kind: manyToOne
//#   needs: i2c_buses simplei2c.h/i2c simplei2c.h/i2c_open hal/TwoWireBus
//#   pin: sclPin digital both
//#   pin: sdaPin digital both
//#   fidelity avr: exact at the pins SCL and SDA; a bus at any other pins is not wired
//#   fidelity other: at any two pins; the clock is never driven high
//#   limit avr: the bus is the one of the hardware: connect devices to SCL and SDA
//#   limit other: two buses at most
//#   stack: 0
inline i2c *i2c_newbus(int32_t sclPin, int32_t sdaPin, int32_t sclDrive) {
  return i2c_open(&i2c_buses[i2c::place(sclPin, sdaPin)], sclPin, sdaPin, sclDrive);
}

//# helper i2c_begin
//#   needs: simplei2c.h/i2c simplei2c.h/i2c_start simplei2c.h/i2c_writeByte
//#   fidelity: addresses a device, then its memory: highest byte first, lowest first when the count is negative; counts acknowledged bytes
inline int32_t i2c_begin(i2c *bus, int32_t address, int32_t memory, int32_t count) {
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
//#   fidelity: exact: the number of bytes that were acknowledged, with the device's address; 100 kHz
//#   stack: 44 22
inline int32_t i2c_out(i2c *busID, int32_t i2cAddr, int32_t memAddr, int32_t memAddrCount, const void *data, int32_t dataCount) {
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
//#   fidelity: exact, with its count of bytes, which leaves out the last one read; 100 kHz
//#   stack: 48 26
inline int32_t i2c_in(i2c *busID, int32_t i2cAddr, int32_t memAddr, int32_t memAddrCount, void *data, int32_t dataCount) {
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
//#   stack: 10 2
inline int32_t i2c_busy(i2c *busID, int32_t i2cAddr) {
  return i2c_poll(busID, i2cAddr << 1 & 0xFE);
}

// ---------------------------------------------------------------- EEPROM

//# adapter ee_putByte
//#   for: void ee_putByte(unsigned char value, int addr)
//#   kind: oneToMany
//#   needs: hal/store
//#   fidelity: exact within the memory of the microcontroller
//#   limit avr: 1 KB instead of 64: addresses repeat every 1,024 bytes; what the source robot kept is not carried over
//#   limit other: 4 KB instead of 64: addresses repeat every 4,096 bytes; what the source robot kept is not carried over
//#   limit avr: a byte that changes takes 3.4 ms, where up to 128 of them take 5 ms there
//#   limit rp2040: a byte that changes takes some 50 ms, in which all else stands still
//#   stack: 2
inline void ee_putByte(uint8_t value, int32_t addr) {
  store_write((uint32_t)addr % store_size, value);
}

//# adapter ee_getByte
//#   for: char ee_getByte(int addr)
//#   kind: oneToMany
//#   needs: hal/store
//#   fidelity: exact within the memory of the microcontroller; 0 to 255
//#   limit avr: 1 KB instead of 64: addresses repeat every 1,024 bytes
//#   limit other: 4 KB instead of 64: addresses repeat every 4,096 bytes
//#   stack: 0
inline uint8_t ee_getByte(int32_t addr) {
  return store_read((uint32_t)addr % store_size);
}

//# adapter ee_putStr
//#   for: void ee_putStr(unsigned char *s, int n, int addr)
//#   kind: oneToMany
//#   needs: ee_putByte
//#   fidelity: exact within the memory of the microcontroller
//#   limit avr: 1 KB instead of 64: addresses repeat every 1,024 bytes
//#   limit other: 4 KB instead of 64: addresses repeat every 4,096 bytes
//#   limit avr: each byte that changes takes 3.4 ms, where up to 128 of them take 5 ms there
//#   limit rp2040: each byte that changes takes some 50 ms, in which all else stands still
//#   stack: 2
inline void ee_putStr(const void *s, int32_t n, int32_t addr) {
  for (int32_t number = 0; number < n; number++) ee_putByte(((const uint8_t *)s)[number], addr + number);
}

//# adapter ee_getStr
//#   for: unsigned char *ee_getStr(unsigned char *s, int n, int addr)
//#   kind: oneToMany
//#   needs: ee_getByte
//#   fidelity: exact within the memory of the microcontroller
//#   limit avr: 1 KB instead of 64: addresses repeat every 1,024 bytes
//#   limit other: 4 KB instead of 64: addresses repeat every 4,096 bytes
//#   stack: 2
template <class Text>
inline Text *ee_getStr(Text *s, int32_t n, int32_t addr) {
  for (int32_t number = 0; number < n; number++) ((uint8_t *)s)[number] = ee_getByte(addr + number);
  return s;
}

//# adapter ee_putInt
//#   for: void ee_putInt(int value, int addr)
//#   kind: oneToMany
//#   needs: ee_putStr
//#   fidelity: exact: four bytes, the lowest first
//#   limit avr: 1 KB instead of 64: addresses repeat every 1,024 bytes
//#   limit other: 4 KB instead of 64: addresses repeat every 4,096 bytes
//#   stack: 12 8
inline void ee_putInt(int32_t value, int32_t addr) {
  ee_putStr(&value, sizeof value, addr);
}

//# adapter ee_getInt
//#   for: int ee_getInt(int addr)
//#   kind: oneToMany
//#   needs: ee_getStr
//#   fidelity: exact: four bytes, the lowest first
//#   limit avr: 1 KB instead of 64: addresses repeat every 1,024 bytes
//#   limit other: 4 KB instead of 64: addresses repeat every 4,096 bytes
//#   stack: 8
inline int32_t ee_getInt(int32_t addr) {
  int32_t value;
  ee_getStr(&value, sizeof value, addr);
  return value;
}

//# adapter ee_putFloat32
//#   for: void ee_putFloat32(float value, int addr)
//#   kind: oneToMany
//#   needs: ee_putStr
//#   fidelity: exact
//#   limit avr: 1 KB instead of 64: addresses repeat every 1,024 bytes
//#   limit other: 4 KB instead of 64: addresses repeat every 4,096 bytes
//#   stack: 12 8
inline void ee_putFloat32(float value, int32_t addr) {
  ee_putStr(&value, sizeof value, addr);
}

//# adapter ee_getFloat32
//#   for: float ee_getFloat32(int addr)
//#   kind: oneToMany
//#   needs: ee_getStr
//#   fidelity: exact
//#   limit avr: 1 KB instead of 64: addresses repeat every 1,024 bytes
//#   limit other: 4 KB instead of 64: addresses repeat every 4,096 bytes
//#   stack: 8
inline float ee_getFloat32(int32_t addr) {
  float value;
  ee_getStr(&value, sizeof value, addr);
  return value;
}

//# adapter ee_config
//#   for: void ee_config(int sclPin, int sdaPin, int sclDrive)
//#   kind: oneToOne
//#   fidelity: nothing to do: the memory is inside of the microcontroller
//#   limit: an EEPROM at pins of its own is not used; call i2c_out and i2c_in for it
//#   stack: 0
inline void ee_config(int32_t sclPin, int32_t sdaPin, int32_t sclDrive) {
  (void)sclPin;
  (void)sdaPin;
  (void)sclDrive;
}

//# adapter ee_put_byte
//#   for: void ee_put_byte(unsigned char value, int addr)
//#   kind: oneToOne
//#   needs: ee_putByte
//#   fidelity: the older name of ee_putByte
//#   limit avr: 1 KB instead of 64: addresses repeat every 1,024 bytes
//#   limit other: 4 KB instead of 64: addresses repeat every 4,096 bytes
//#   stack: 2
inline void ee_put_byte(uint8_t value, int32_t addr) {
  ee_putByte(value, addr);
}

//# adapter ee_get_byte
//#   for: char ee_get_byte(int addr)
//#   kind: oneToOne
//#   needs: ee_getByte
//#   fidelity: the older name of ee_getByte
//#   limit avr: 1 KB instead of 64: addresses repeat every 1,024 bytes
//#   limit other: 4 KB instead of 64: addresses repeat every 4,096 bytes
//#   stack: 0
inline uint8_t ee_get_byte(int32_t addr) {
  return ee_getByte(addr);
}

//# adapter ee_put_int
//#   for: void ee_put_int(int value, int addr)
//#   kind: oneToOne
//#   needs: ee_putInt
//#   fidelity: the older name of ee_putInt
//#   limit avr: 1 KB instead of 64: addresses repeat every 1,024 bytes
//#   limit other: 4 KB instead of 64: addresses repeat every 4,096 bytes
//#   stack: 12 8
inline void ee_put_int(int32_t value, int32_t addr) {
  ee_putInt(value, addr);
}

//# adapter ee_get_int
//#   for: int ee_get_int(int addr)
//#   kind: oneToOne
//#   needs: ee_getInt
//#   fidelity: the older name of ee_getInt
//#   limit avr: 1 KB instead of 64: addresses repeat every 1,024 bytes
//#   limit other: 4 KB instead of 64: addresses repeat every 4,096 bytes
//#   stack: 8
inline int32_t ee_get_int(int32_t addr) {
  return ee_getInt(addr);
}

//# adapter ee_put_str
//#   for: void ee_put_str(unsigned char *s, int n, int addr)
//#   kind: oneToOne
//#   needs: ee_putStr
//#   fidelity: the older name of ee_putStr
//#   limit avr: 1 KB instead of 64: addresses repeat every 1,024 bytes
//#   limit other: 4 KB instead of 64: addresses repeat every 4,096 bytes
//#   stack: 2
inline void ee_put_str(const void *s, int32_t n, int32_t addr) {
  ee_putStr(s, n, addr);
}

//# adapter ee_get_str
//#   for: unsigned char *ee_get_str(unsigned char *s, int n, int addr)
//#   kind: oneToOne
//#   needs: ee_getStr
//#   fidelity: the older name of ee_getStr
//#   limit avr: 1 KB instead of 64: addresses repeat every 1,024 bytes
//#   limit other: 4 KB instead of 64: addresses repeat every 4,096 bytes
//#   stack: 2
template <class Text>
inline Text *ee_get_str(Text *s, int32_t n, int32_t addr) {
  return ee_getStr(s, n, addr);
}

//# adapter ee_put_float32
//#   for: void ee_put_float32(float value, int addr)
//#   kind: oneToOne
//#   needs: ee_putFloat32
//#   fidelity: the older name of ee_putFloat32
//#   limit avr: 1 KB instead of 64: addresses repeat every 1,024 bytes
//#   limit other: 4 KB instead of 64: addresses repeat every 4,096 bytes
//#   stack: 12 8
inline void ee_put_float32(float value, int32_t addr) {
  ee_putFloat32(value, addr);
}

// ---------------------------------------------------------------- memory card

//# adapter sd_mount
//#   for: int sd_mount(int doPin, int clkPin, int diPin, int csPin)
//#   kind: semantic
//#   needs: hal/Io
//#   include: <SD.h>
//#   library: SD
//#   pin: doPin digital in
//#   pin: clkPin digital out
//#   pin: diPin digital out
//#   pin: csPin digital out
//#   fidelity: 0 when the card is ready, else another number
//#   limit avr: the card has to be at the pins of SPI (on an Uno 12, 13 and 11); at any others it is not wired
//#   limit other: the card has to be at the pins of SPI; at any others it is not wired
//#   stack: 0
inline int32_t sd_mount(int32_t doPin, int32_t clkPin, int32_t diPin, int32_t csPin) {
  if (doPin != MISO || clkPin != SCK || diPin != MOSI || !Io(csPin).wired()) return 1;
  return SD.begin((uint8_t)csPin) ? 0 : 1;
}

// ---------------------------------------------------------------- arithmetic

//# constant PI
//#   fidelity: the target has it, with the same value
static_assert(PI == 3.141592653589793, "PI is that in simpletools.h");

//# adapter constrainInt
//#   for: int constrainInt(int value, int min, int max)
//#   kind: oneToOne
//#   symmetric: value lowest
//#   fidelity: exact: the middle one of the three, since the limits may come in either order
//#   stack: 0
inline int32_t constrainInt(int32_t value, int32_t lowest, int32_t highest) {
  if (lowest > highest) return constrainInt(value, highest, lowest);
  return value < lowest ? lowest : value > highest ? highest : value;
}

//# adapter constrainFloat
//#   for: float constrainFloat(float value, float min, float max)
//#   kind: oneToOne
//#   symmetric: value lowest
//#   fidelity: exact: the middle one of the three, since the limits may come in either order
//#   stack: 4
inline float constrainFloat(float value, float lowest, float highest) {
  if (lowest > highest) return constrainFloat(value, highest, lowest);
  return value < lowest ? lowest : value > highest ? highest : value;
}

//# adapter mapInt
//#   for: int mapInt(int value, int fromMin, int fromMax, int toMin, int toMax)
//#   kind: semantic
//#   fidelity: exact: to the nearest integer, halves away from zero, where map() cuts off
//#   stack: 0
inline int32_t mapInt(int32_t value, int32_t fromMin, int32_t fromMax, int32_t toMin, int32_t toMax) {
  int32_t product = (value - fromMin) * (toMax - toMin), range = fromMax - fromMin;
  int32_t steps = (labs(product) + labs(range) / 2) / labs(range);
  return (product < 0) == (range < 0) ? toMin + steps : toMin - steps;
}

//# adapter mapFloat
//#   for: float mapFloat(float value, float fromMin, float fromMax, float toMin, float toMax)
//#   kind: oneToOne
//#   fidelity: exact
//#   stack: 0
inline float mapFloat(float value, float fromMin, float fromMax, float toMin, float toMax) {
  return (value - fromMin) * (toMax - toMin) / (fromMax - fromMin) + toMin;
}

//# adapter endianSwap
//#   for: void endianSwap(void *resultAddr, void *varAddr, int byteCount)
//#   kind: oneToMany
//#   fidelity: exact
//#   stack: 0
inline void endianSwap(void *resultAddr, const void *varAddr, int32_t byteCount) {
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
//#   fidelity: both limits inclusive, in either order; rand() behind it has 15 bits, as there
//#   limit: the first call seeds from the time and an open analog input: other numbers than there
//#   stack: 24 8
inline int32_t random_between(int32_t limitLow, int32_t limitHigh) {
  if (!random_seeded) c_srand(analogRead(A0) * 257u + CNT);
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
//#   limit: the Serial Monitor of the Arduino IDE does not obey commands; a Parallax terminal does
//#   stack: 22 14
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
template <class... Numbers>
inline void term_cmd(int32_t termConst, Numbers... numbers) {
  const char values[] = {(char)numbers..., 0, 0};
  uint8_t count = termConst == CRSRXY ? 2 : termConst == CRSRX || termConst == CRSRY ? 1 : 0;
  writeByte(simpleterm_pointer(), (char)termConst);
  for (uint8_t number = 0; number < count; number++) writeByte(simpleterm_pointer(), values[number]);
}

// ---------------------------------------------------------------- counters of a cog, as constants

//# constant CTR_NCO
#define CTR_NCO 0x10000000L

//# constant NCO_PWM_1
#define NCO_PWM_1 0x10000000L

//# constant CTR_PLL
#define CTR_PLL 0x8000000L

//# constant DUTY_SE
#define DUTY_SE 0x18000000L

// ---------------------------------------------------------------- cogs

//# helper CogInfo
//#   fidelity: what cog_run gives back, a pointer to the cog's number plus 1; it fits any pointer to a number
struct CogInfo {
  int32_t *number;

  template <class Number>
  operator Number *() const { return (Number *)number; }
  explicit operator bool() const { return number; }
  explicit operator int32_t() const { return (int32_t)(intptr_t)number; }
};

//# helper cog_numbers
//#   needs: propeller.h/COG_SLOTS
//#   fidelity: the numbers of the cogs plus 1, where cog_run's callers look for them
//#   ram: 4
static int32_t cog_numbers[COG_SLOTS];

//# adapter cog_run
//#   for: int *cog_run(void (*function)(void *par), int stacksize)
//#   kind: semantic
//#   needs: CogInfo cog_numbers propeller.h/cog_start
//#   fidelity: runs the function whenever the others wait; 0 when no cog is free
//#   limit: the size of the stack is not used: each cog has COG_STACK bytes
//#   stack: 7 2
inline CogInfo cog_run(void (*function)(void *par), int32_t stacksize) {
  (void)stacksize;
  int8_t number = cog_start(function, 0);
  if (number < 0) return CogInfo{0};
  cog_numbers[number - 1] = number + 1;
  return CogInfo{&cog_numbers[number - 1]};
}

//# adapter cog_end
//#   for: void cog_end(int *coginfo)
//#   kind: semantic
//#   needs: propeller.h/cog_stop
//#   fidelity: exact; nothing happens where no cog was started
//#   stack: 75 65
template <class Number>
inline void cog_end(Number *coginfo) {
  int32_t number = coginfo ? *coginfo - 1 : -1;
  if (number < 0) return;
  *coginfo = 0;
  cog_stop(number);
}

//# adapter cog_num
//#   for: int cog_num(int *coginfo)
//#   kind: oneToOne
//#   fidelity: exact
//#   stack: 0
template <class Number>
inline int32_t cog_num(Number *coginfo) {
  return *coginfo - 1;
}
