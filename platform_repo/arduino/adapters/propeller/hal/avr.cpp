//# header hal
//# architecture avr
// The hardware layer on AVR microcontrollers (ATmega328P, 32U4, 2560): registers, timers, interrupts, instructions.
// What each piece promises is written in docs/reference/hardware-layer.md. A tick of an edge is 1/16 us on every target.

// ---------------------------------------------------------------- numbers

//# helper SourceInt
typedef int32_t SourceInt;  // the int of the source, as programs have it here

// ---------------------------------------------------------------- interrupts

//# helper Uninterrupted
struct Uninterrupted {  // interrupts are off as long as it lives
  uint8_t before;
  __attribute__((always_inline)) Uninterrupted() : before(SREG) { cli(); }
  __attribute__((always_inline)) ~Uninterrupted() { SREG = before; }
};

// ---------------------------------------------------------------- pins

//# helper Io
//#   fidelity: OUTA and DIRA are independent on the Propeller and a released pin floats. PORT = 1 at an input of an AVR is a pull-up, so the
//#   fidelity: output latch is kept here, and reaches PORT only while the pin is an output.
//#   ram: 5
#ifdef PORTA
const uint8_t first_port = 1;  // numbers of the core: 1 is port A, and there is no I
#else
const uint8_t first_port = 2;
#endif
#if defined(PORTL)
const uint8_t last_port = 12;
#elif defined(PORTJ)
const uint8_t last_port = 10;
#elif defined(PORTG)
const uint8_t last_port = 7;
#elif defined(PORTF)
const uint8_t last_port = 6;
#elif defined(PORTE)
const uint8_t last_port = 5;
#else
const uint8_t last_port = 4;
#endif
static uint8_t latches[last_port - first_port + 1];
static uint8_t *cog_pins_now = 0;  // which pins the cog that runs drives; 0 where nothing needs to know

// The cog that runs drives the pin, or no longer does.
__attribute__((always_inline)) inline void cog_drives(uint8_t pin, bool output) {
  if (!cog_pins_now) return;
  uint8_t bit = 1 << (pin & 7);
  if (output) cog_pins_now[pin >> 3] |= bit;
  else cog_pins_now[pin >> 3] &= ~bit;
}

struct Io {  // one pin, ready for access to its registers
  uint8_t pin, mask, *kept;
  volatile uint8_t *in, *direction, *out;

  explicit Io(int32_t number) : pin(number), mask(0), kept(0), in(0), direction(0), out(0) {
    if (number < 0 || number >= NUM_DIGITAL_PINS) return;
    uint8_t port = digitalPinToPort(pin);
    kept = latches + (port - first_port);
    mask = digitalPinToBitMask(pin);
    in = portInputRegister(port);
    direction = portModeRegister(port);
    out = portOutputRegister(port);
  }
  bool wired() const { return mask != 0; }
  bool high() const { return wired() && (*in & mask); }
  bool driven() const { return wired() && (*direction & mask); }
  bool latch() const { return wired() && (*kept & mask); }
  void put(volatile uint8_t *to, bool value) const {
    uint8_t old = SREG;
    cli();
    if (value) *to |= mask;
    else *to &= ~mask;
    SREG = old;
  }
  void set(bool value) const {
    if (!wired()) return;
    if (value) *kept |= mask;
    else *kept &= ~mask;
    if (driven()) put(out, value);
  }
  void own(bool output) const { cog_drives(pin, output); }
  void drive_for_library() const {  // whose own cog goes on when the caller ends
    drive(true);
    if (wired()) own(false);
  }
  void drive(bool output) const {
    if (!wired()) return;
    own(output);
    if (output) {
      put(out, latch());
      put(direction, true);
    } else {
      put(direction, false);
      put(out, false);
    }
  }
  void level(bool value) const {
    if (!wired()) return;
    digitalWrite(pin, value);  // which ends a wave of a timer there
    set(value);
    drive(true);
  }
};

//# helper own_pins
//#   needs: Io
//#   fidelity: which pins the program drives; one that only rests at a level since setup is none
//#   ram: 3
static uint8_t own_pins[(NUM_DIGITAL_PINS + 7) / 8];

struct OwnPins {
  OwnPins() {
    if (!cog_pins_now) cog_pins_now = own_pins;
  }
};
static OwnPins own_pins_begun;

template <class Pin>
__attribute__((always_inline)) inline bool owned(const Pin &io) {
  return io.wired() && cog_pins_now[io.pin >> 3] >> (io.pin & 7) & 1;
}

//# helper pin_places
//#   fidelity: port and bit of each pin on the boards of the core. Its own tables are in the program memory, where no compiler reads them
#if defined(ARDUINO_AVR_UNO) || defined(ARDUINO_AVR_NANO) || defined(ARDUINO_AVR_PRO) || defined(ARDUINO_AVR_MINI) || \
    defined(ARDUINO_AVR_DUEMILANOVE) || defined(ARDUINO_AVR_FIO) || defined(ARDUINO_AVR_LILYPAD) || defined(ARDUINO_AVR_BT) || \
    defined(ARDUINO_AVR_ETHERNET)
constexpr char pin_ports[] = "DDDDDDDDBBBBBBCCCCCC", pin_bits[] = "01234567012345012345";
#else
constexpr char pin_ports[] = "", pin_bits[] = "";  // another board: each pin is looked up
#endif

//# helper pin_places
//#   mcu: atmega32u4
#if defined(ARDUINO_AVR_LEONARDO) || defined(ARDUINO_AVR_MICRO) || defined(ARDUINO_AVR_LILYPAD_USB) || defined(ARDUINO_AVR_YUN)
constexpr char pin_ports[] = "DDDDDCDEBBBBDCBBBBFFFFFFDDBBBDD", pin_bits[] = "2310467645676731207654104745665";
#else
constexpr char pin_ports[] = "", pin_bits[] = "";  // another board: each pin is looked up
#endif

//# helper pin_places
//#   mcu: atmega2560
#if defined(ARDUINO_AVR_MEGA2560) || defined(ARDUINO_AVR_ADK)
constexpr char pin_ports[] = "EEEEGEHHHHBBBBJJHHDDDDAAAAAAAACCCCCCCCDGGGLLLLLLLLBBBBFFFFFFFFKKKKKKKK";
constexpr char pin_bits[] = "0145533456456710103210012345677654321072107654321032100123456701234567";
#else
constexpr char pin_ports[] = "", pin_bits[] = "";  // another board: each pin is looked up
#endif

//# helper KnownIo
//#   needs: Io pin_places
//#   fidelity: as Io, for a pin that the compiler knows: some instructions, where Io looks for registers and masks
__attribute__((always_inline)) inline bool pin_is_known(int32_t number) {
  return sizeof pin_ports == NUM_DIGITAL_PINS + 1 && __builtin_constant_p(number);
}

struct KnownIo {
  uint8_t pin, mask, *kept;
  volatile uint8_t *in;  // PINx; DDRx and PORTx are the registers behind it

  __attribute__((always_inline)) explicit KnownIo(int32_t number) : pin(number), mask(0), kept(0), in(0) {
    if (number < 0 || number >= NUM_DIGITAL_PINS) return;
    char port = pin_ports[number];
    kept = latches + (port - 'A' - (port > 'I') + 1 - first_port);  // no port is called I
    mask = 1 << (pin_bits[number] - '0');
    in = port < 'H' ? (volatile uint8_t *)0x20 + 3 * (port - 'A') : (volatile uint8_t *)0x100 + 3 * (port - 'H' - (port > 'I'));
  }
  __attribute__((always_inline)) bool wired() const { return mask != 0; }
  __attribute__((always_inline)) bool high() const { return mask && (*in & mask); }
  __attribute__((always_inline)) bool driven() const { return mask && (in[1] & mask); }
  __attribute__((always_inline)) bool latch() const { return mask && (*kept & mask); }
  __attribute__((always_inline)) void put(volatile uint8_t *to, bool value) const {
    bool far = to >= (volatile uint8_t *)0x40;  // below, it is one instruction
    uint8_t old = far ? SREG : 0;
    if (far) cli();
    if (value) *to |= mask;
    else *to &= ~mask;
    if (far) SREG = old;
  }
  __attribute__((always_inline)) void keep(bool value) const {
    if (value) *kept |= mask;
    else *kept &= ~mask;
  }
  __attribute__((always_inline)) void set(bool value) const {
    if (!mask) return;
    keep(value);
    if (driven()) put(in + 2, value);
  }
  __attribute__((always_inline)) void drive(bool output) const {
    if (!mask) return;
    cog_drives(pin, output);
    if (output) {
      put(in + 2, latch());
      put(in + 1, true);
    } else {
      put(in + 1, false);
      put(in + 2, false);
    }
  }
  __attribute__((always_inline)) void level(bool value) const {  // an output with that level; a wave of a timer ends
    if (!mask) return;
    keep(value);
    if (digitalPinHasPWM(pin)) digitalWrite(pin, value);
    else put(in + 2, value);
    cog_drives(pin, true);
    put(in + 1, true);
  }
};

// ---------------------------------------------------------------- time of edges

//# helper PinInput
struct PinInput {  // the level of a wired pin, read fast
  volatile uint8_t *in;
  uint8_t mask;

  bool wired() const { return mask; }
  bool high() const { return *in & mask; }
};

template <class Pin> inline PinInput input_of(const Pin &io) { return {io.in, io.mask}; }

//# helper pulse
//#   needs: PinInput
inline void pulse(PinInput io, uint32_t width) {  // the pin, an output, is inverted for so many microseconds
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

template <class Pin> inline void pulse(const Pin &io, uint32_t width) { pulse(input_of(io), width); }

//# helper edge_clock
//#   fidelity: micros() moves in steps of 4 us; counting up to the next step of Timer0 makes an edge known to 6 cycles
inline uint32_t edge_clock() {  // the time in 1/16 us, as of the call
  uint8_t old = SREG, turns = 0;
  cli();
  uint8_t tick = TCNT0;
  asm volatile(
      "1: in __tmp_reg__, %1\n\tcp __tmp_reg__, %2\n\tbrne 2f\n\tinc %0\n\trjmp 1b\n2:"
      : "+r"(turns)
      : "I"(_SFR_IO_ADDR(TCNT0)), "r"(tick));
  uint32_t now = micros() * 16UL;
  SREG = old;
  const uint8_t turn = 96 / clockCyclesPerMicrosecond();  // 6 cycles, in 1/16 us
  return now - (uint16_t)(turns * turn);
}

//# helper edge_stamp
extern volatile unsigned long timer0_overflow_count;  // of the core

inline uint16_t edge_stamp() {  // as edge_clock, of 16 bits and faster; interrupts are off
  uint8_t turns = 0, tick = TCNT0;
  asm volatile(
      "1: in __tmp_reg__, %1\n\tcp __tmp_reg__, %2\n\tbrne 2f\n\tinc %0\n\trjmp 1b\n2:"
      : "+r"(turns)
      : "I"(_SFR_IO_ADDR(TCNT0)), "r"(tick));
  uint8_t periods = (uint8_t)timer0_overflow_count;
  tick = TCNT0;
  if ((TIFR0 & _BV(TOV0)) && tick < 255) periods++;
  const uint8_t turn = 96 / clockCyclesPerMicrosecond(), step = 1024 / clockCyclesPerMicrosecond();  // 6 and 64 cycles, in 1/16 us
  return (uint16_t)(periods << 8 | tick) * step - turns * turn;
}

//# helper leaves
//#   needs: Io edge_clock
//#   fidelity: an edge is known to 1 us; one that came while an interrupt ran, to half of the time that it took
__attribute__((noinline))  // its loop has 14 cycles only where all that it needs is in registers
inline bool leaves(const Io &io, bool high, uint32_t begun, uint32_t limit, uint32_t &at) {  // waits while the pin has the level
  const uint8_t turn = 224 / clockCyclesPerMicrosecond(), step = 1024 / clockCyclesPerMicrosecond();  // 14 and 64 cycles, in 1/16 us
  uint8_t level = high ? io.mask : 0;
  uint16_t burst = limit > 20000 ? 2000 : 60;  // the clock is looked at rarely: that costs 4 us
  uint8_t tick = TCNT0, now, turns = 0;         // the last look with that level: so many turns of 14 cycles behind that step of Timer0
  do {
    for (uint16_t left = burst; left; left--) {
      now = TCNT0;
      if ((*io.in & io.mask) != level) {
        at = edge_clock();
        at -= (uint16_t)((uint16_t)at - tick * step - turns * turn) % (uint16_t)(256u * step) / 2;
        return true;
      }
      turns++;
      if (now == tick) continue;
      tick = now;
      turns = 0;
    }
  } while (micros() - begun < limit);
  at = edge_clock();
  return false;
}

// ---------------------------------------------------------------- pin watch

//# helper PinWatch
//#   fidelity: one handler of pin-change interrupts for all that waits for them
//#   ram: 2
struct PinWatch {
  volatile uint8_t *in;  // the pin's register and bit
  uint8_t mask, level;
  void (*changed)(PinWatch &watch);
  PinWatch *next;
};
static PinWatch *pin_watches;

inline void pins_changed() {
  for (PinWatch *watch = pin_watches; watch; watch = watch->next) {
    uint8_t level = *watch->in & watch->mask;
    if (level == watch->level) continue;
    watch->level = level;
    watch->changed(*watch);
  }
}

inline void end_watch(PinWatch &watch) {
  uint8_t old = SREG;
  cli();
  for (PinWatch **link = &pin_watches; *link; link = &(*link)->next) {
    if (*link != &watch) continue;
    *link = watch.next;
    break;
  }
  SREG = old;
}

inline bool begin_watch(PinWatch &watch, int16_t pin, void (*changed)(PinWatch &watch)) {
  if (!digitalPinToPCICR(pin)) return false;
  uint8_t old = SREG;
  cli();
  watch.in = portInputRegister(digitalPinToPort(pin));
  watch.mask = digitalPinToBitMask(pin);
  watch.level = *watch.in & watch.mask;
  watch.changed = changed;
  watch.next = pin_watches;
  pin_watches = &watch;
  *digitalPinToPCMSK(pin) |= _BV(digitalPinToPCMSKbit(pin));
  *digitalPinToPCICR(pin) |= _BV(digitalPinToPCICRbit(pin));
  SREG = old;
  return true;
}

//# helper watch_pin
//#   needs: PinWatch
//#   vector: PCINT0_vect PCINT1_vect PCINT2_vect
inline bool watch_pin(PinWatch &watch, int16_t pin, void (*changed)(PinWatch &watch)) {  // false: no such interrupt
  return begin_watch(watch, pin, changed);
}

ISR(PCINT0_vect) { pins_changed(); }
ISR(PCINT1_vect) { pins_changed(); }
ISR(PCINT2_vect) { pins_changed(); }

//# helper watch_pin
//#   needs: PinWatch
//#   vector: PCINT0_vect
//#   mcu: atmega32u4
inline bool watch_pin(PinWatch &watch, int16_t pin, void (*changed)(PinWatch &watch)) {  // false: no such interrupt
  return begin_watch(watch, pin, changed);
}

ISR(PCINT0_vect) { pins_changed(); }

// ---------------------------------------------------------------- periodic jobs

//# helper periods
//#   vector: TIMER0_COMPA_vect
inline void period_comes();

ISR(TIMER0_COMPA_vect, ISR_NOBLOCK) { period_comes(); }

inline void count_periods() {
  if (!OCR0A) OCR0A = 128;  // not right behind the core's interrupt of that timer
  TIMSK0 |= _BV(OCIE0A);
}

// ---------------------------------------------------------------- servos

//# helper servo_timer
//#   servos: 12
//#   include: <Servo.h>
//#   library: Servo
//#   timer: Timer1
//#   taken: TIMER1_COMPA_vect
//#   fidelity: the timer with which Servo.h makes its pulses: it counts half microseconds (at 16 MHz) from the begin of a frame
#define SERVO_COUNT TCNT1
#define SERVO_BEGIN OCR1A  // when Servo.h begins its next frame, while it makes no pulse
#define SERVO_JOB OCR1B    // when the frame jobs are due
#define SERVO_MASK TIMSK1
#define SERVO_PENDING TIFR1
#define SERVO_CLOCK TCCR1B
#define SERVO_MODE TCCR1A

//# helper servo_timer
//#   mcu: atmega2560
//#   include: <Servo.h>
//#   library: Servo
//#   timer: Timer5
//#   taken: TIMER5_COMPA_vect
#define SERVO_COUNT TCNT5
#define SERVO_BEGIN OCR5A
#define SERVO_JOB OCR5B
#define SERVO_MASK TIMSK5
#define SERVO_PENDING TIFR5
#define SERVO_CLOCK TCCR5B
#define SERVO_MODE TCCR5A

//# helper frame_ticks
//#   needs: servo_timer
const uint16_t frame_ticks = clockCyclesPerMicrosecond() * 2500UL;  // 20 ms
const uint16_t job_ticks = frame_ticks / 10 * 9;                    // jobs are 2 ms earlier than pulses

inline bool servo_pulses() { return SERVO_MASK & _BV(OCIE1A); }  // whether Servo.h makes any

//# helper frame_interrupt
//#   needs: servo_timer
//#   vector: TIMER1_COMPB_vect
inline void frame_is_due();

ISR(TIMER1_COMPB_vect) { frame_is_due(); }

inline void begin_frames() {
  SERVO_PENDING = _BV(OCF1B);
  SERVO_MASK |= _BV(OCIE1B);
}

//# helper frame_interrupt
//#   mcu: atmega2560
//#   needs: servo_timer
//#   vector: TIMER5_COMPB_vect
inline void frame_is_due();

ISR(TIMER5_COMPB_vect) { frame_is_due(); }

inline void begin_frames() {
  SERVO_PENDING = _BV(OCF1B);
  SERVO_MASK |= _BV(OCIE1B);
}

//# helper frame_clock
//#   needs: servo_timer frame_ticks frame_interrupt
//#   ram: 2
inline void frame_is_owed();
inline void frame_comes();

inline void frame_is_due() {  // Servo.h begins each frame later than it should, by what its interrupt takes: here that is made good
  static uint16_t due;
  uint16_t late = (uint16_t)micros() - due;
  if (!servo_pulses()) SERVO_JOB += frame_ticks;
  else SERVO_JOB = job_ticks;
  if (late > 500) due += late;
  else if (servo_pulses() && SERVO_BEGIN == frame_ticks) SERVO_BEGIN = frame_ticks - min(late, 20) * (frame_ticks / 20000);
  due += 20000;
  frame_is_owed();
  sei();
  frame_comes();
}

inline void count_frames() {
  if (SERVO_MASK & _BV(OCIE1B)) return;
  if (!servo_pulses()) {
    SERVO_MODE = 0;
    SERVO_CLOCK = _BV(CS11);
  }
  SERVO_JOB = servo_pulses() ? job_ticks : SERVO_COUNT + frame_ticks;
  begin_frames();
}

//# helper ServoPin
//#   needs: Io servo_timer frame_ticks
const uint8_t servo_places = MAX_SERVOS < 14 ? MAX_SERVOS : 14;

struct ServoPin {
  Servo *servo;                // made once: each one counts as a channel of Servo.h from then on
  uint8_t pin;

  void start(int16_t us) {  // Servo.h lets its timer begin anew with the first servo: frames go on in their time
    uint8_t old = SREG;
    cli();
    bool counted = servo_pulses();
    uint16_t before = SERVO_COUNT, left = SERVO_JOB - before;  // until the frame jobs are due
    if (counted && before >= SERVO_JOB) left += frame_ticks;
    if (!(SERVO_MASK & _BV(OCIE1B))) left = job_ticks + 1000;
    servo->attach(pin, 40, 2900);
    servo->writeMicroseconds(us);
    if (!counted || SERVO_COUNT < before) {
      SERVO_JOB = left < job_ticks ? left : job_ticks;
      SERVO_BEGIN = left < job_ticks ? left + (frame_ticks - job_ticks) : max(left - job_ticks, 100);
    }
    SREG = old;
  }
  void rest() {  // no more pulses; one under way is ended first
    Io io(pin);
    while (servo->attached()) {
      uint8_t old = SREG;
      cli();
      if (!(*io.out & io.mask)) servo->detach();
      if (!servo_pulses() && SERVO_COUNT >= SERVO_JOB) SERVO_JOB += frame_ticks;
      SREG = old;
    }
  }
};

//# helper quiet_of_servos
//#   fidelity: waits until no pulse of Servo.h begins or ends for so many microseconds, at most a frame of 20 ms
inline void quiet_of_servos(uint32_t us) {
#ifdef TCNT5
  volatile uint16_t &count = TCNT5, &next = OCR5A;
  volatile uint8_t &mask = TIMSK5, &pending = TIFR5;
#else
  volatile uint16_t &count = TCNT1, &next = OCR1A;
  volatile uint8_t &mask = TIMSK1, &pending = TIFR1;
#endif
  if (us > 15000) return;  // no frame has room for that
  uint16_t least = (us + 24) * clockCyclesPerMicrosecond() / 8, most = clockCyclesPerMicrosecond() * 2500UL;
  for (uint32_t begun = micros(); mask & _BV(OCIE1A) && micros() - begun < 20000;) {
    uint8_t old = SREG;
    cli();
    uint16_t left = next - count;
    bool due = pending & _BV(OCF1A);
    SREG = old;
    if (!due && left > least && left <= most) return;
  }
}

// ---------------------------------------------------------------- tone and slow waves

//# helper tones
//#   needs: Io
//#   timer: Timer2
inline void begin_tone(const Io &io, uint16_t frequency) { tone(io.pin, frequency); }

inline void end_tone(const Io &io) { noTone(io.pin); }

//# helper tones
//#   needs: Io
//#   timer: Timer3
//#   mcu: atmega32u4
inline void begin_tone(const Io &io, uint16_t frequency) { tone(io.pin, frequency); }

inline void end_tone(const Io &io) { noTone(io.pin); }

//# helper wave_timer
//#   timer: Timer2
//#   fidelity: the timer of tone(), which makes slow waves by itself: it counts 1,024 cycles of the clock
#define WAVE_NEXT OCR2B
#define WAVE_COUNT TCNT2
#define WAVE_MASK TIMSK2
#define WAVE_PENDING TIFR2
#define WAVE_MODE TCCR2A
#define WAVE_CLOCK TCCR2B
const uint8_t slow_clock = _BV(CS22) | _BV(CS21) | _BV(CS20), usual_clock = _BV(CS22), usual_mode = _BV(WGM20);
const uint8_t wave_bit = _BV(OCIE2B);

//# helper wave_timer
//#   mcu: atmega32u4
//#   timer: Timer3
#define WAVE_NEXT OCR3B
#define WAVE_COUNT TCNT3
#define WAVE_MASK TIMSK3
#define WAVE_PENDING TIFR3
#define WAVE_MODE TCCR3A
#define WAVE_CLOCK TCCR3B
const uint8_t slow_clock = _BV(CS32) | _BV(CS30), usual_clock = _BV(CS31) | _BV(CS30), usual_mode = _BV(WGM30);
const uint8_t wave_bit = _BV(OCIE3B);

//# helper wave_interrupt
//#   needs: wave_timer
//#   vector: TIMER2_COMPB_vect
inline void slow_wave_due();

ISR(TIMER2_COMPB_vect) { slow_wave_due(); }

inline void interrupt_for_waves() {
  WAVE_PENDING = wave_bit;
  WAVE_MASK = wave_bit;
}

//# helper wave_interrupt
//#   mcu: atmega32u4
//#   needs: wave_timer
//#   vector: TIMER3_COMPB_vect
inline void slow_wave_due();

ISR(TIMER3_COMPB_vect) { slow_wave_due(); }

inline void interrupt_for_waves() {
  WAVE_PENDING = wave_bit;
  WAVE_MASK = wave_bit;
}

//# helper slow_wave
//#   needs: Io wave_timer wave_interrupt
//#   fidelity: up to 30 Hz, each edge within 64 us of its time
//#   ram: 10
struct SlowWave {
  volatile uint8_t *out;
  uint8_t mask;
  uint8_t twice, rest, sum;  // what a half period has beyond its counts: rest / twice of one
  uint16_t half, left;       // counts of a half period, and from the next compare to the next edge
};
static SlowWave slow_wave;

inline void slow_wave_due() {
  SlowWave &wave = slow_wave;
  if (WAVE_CLOCK != slow_clock) return;  // a tone has taken the timer
  if (!wave.left) {
    *wave.out ^= wave.mask;
    wave.left = wave.half;
    wave.sum += wave.rest;
    if (wave.sum >= wave.twice) {
      wave.sum -= wave.twice;
      wave.left++;
    }
  }
  uint8_t step = wave.left > 200 ? 100 : wave.left;
  wave.left -= step;
  WAVE_NEXT += step;
}

inline bool slow_wave_runs() { return WAVE_MASK & wave_bit; }

inline void begin_slow_wave(const Io &io, uint8_t frequency) {  // low first, as there; a wave that runs goes on
  const uint16_t counts = F_CPU / 1024;                         // of a second
  uint8_t old = SREG;
  cli();
  slow_wave.twice = 2 * frequency;
  slow_wave.half = counts / slow_wave.twice;
  slow_wave.rest = counts % slow_wave.twice;
  slow_wave.sum = 0;
  if (!slow_wave_runs()) {
    slow_wave.out = io.out;
    slow_wave.mask = io.mask;
    slow_wave.left = slow_wave.half - 100;
    WAVE_MODE = 0;
    WAVE_CLOCK = slow_clock;
    WAVE_COUNT = 0;
    WAVE_NEXT = 100;
    interrupt_for_waves();
  }
  SREG = old;
}

inline void end_slow_wave() {
  WAVE_MASK = 0;
  WAVE_MODE = usual_mode;  // as the core begins
  WAVE_CLOCK = usual_clock;
}

// ---------------------------------------------------------------- pulses of two channels

//# helper pwm_channels
//#   timer: Timer1
//#   fidelity: the pulses of each channel; `end` and that of the next cycle on are in counts of Timer1 from the begin of the cycle
//#   ram: 26
struct PwmChannel {
  uint8_t pin, mask;
  volatile uint8_t *out;
  uint16_t end, next_end;
  uint32_t microseconds;
  bool high;
};
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
inline void pwm_end_pulses() {
  uint16_t next = 0xFFFF;
  for (volatile PwmChannel &channel : pwm_channels) {
    if (!channel.high) continue;
    if (channel.end <= TCNT1 + 8) {
      *channel.out &= ~channel.mask;
      channel.high = false;
    } else if (channel.end < next) {
      next = channel.end;
    }
  }
  OCR1B = next;
}

//# helper pwm_counts
//#   needs: pwm_channels pwm_cycle pwm_end_pulses
//#   timer: Timer1
//#   vector: TIMER1_COMPA_vect TIMER1_COMPB_vect
//#   fidelity: half microseconds in cycles up to 32.7 ms, 4 us beyond
ISR(TIMER1_COMPA_vect) {  // a cycle begins
  for (volatile PwmChannel &channel : pwm_channels) {
    channel.end = channel.next_end;
    if (!channel.end) continue;
    *channel.out |= channel.mask;
    channel.high = true;
  }
  pwm_end_pulses();
}
ISR(TIMER1_COMPB_vect) {
  pwm_end_pulses();
}
inline uint16_t pwm_counts(uint32_t microseconds) {
  if (microseconds >= pwm_cycle) return microseconds ? 0xFFFF : 0;  // it never ends
  return pwm_cycle > 32767 ? microseconds / 4 : microseconds * 2;
}

//# helper pwm_pair
//#   needs: Io pwm_channels pwm_cycle pwm_counts
//#   timer: Timer1
inline void set_pwm_pair(uint8_t channel, const Io &io, uint32_t microseconds) {
  volatile PwmChannel &it = pwm_channels[channel];
  Io before(it.pin);
  uint8_t old = SREG;
  cli();
  bool same = it.out == io.out && it.mask == io.mask, moved = it.out && !same;
  it.pin = io.pin;
  it.mask = io.mask;
  it.out = io.out;
  it.high = it.high && !moved;
  it.microseconds = io.wired() ? microseconds : 0;
  it.next_end = io.wired() ? pwm_counts(microseconds) : 0;
  SREG = old;
  if (moved) before.drive(false);
  if (pwm_cycle && !same) io.drive_for_library();  // which would cut a pulse
}

inline void begin_pwm_pair(uint32_t cycle) {
  bool slow = cycle > 32767;
  uint8_t old = SREG;
  cli();
  pwm_cycle = cycle;
  for (volatile PwmChannel &channel : pwm_channels) {
    if (!channel.out) continue;
    channel.end = channel.next_end = pwm_counts(channel.microseconds);
    Io(channel.pin).drive_for_library();
  }
  TCCR1A = 0;
  TCCR1B = _BV(WGM12) | (slow ? _BV(CS11) | _BV(CS10) : _BV(CS11));  // up to OCR1A, again and again
  OCR1A = (uint16_t)((slow ? cycle / 4 : cycle * 2) - 1);
  OCR1B = 0xFFFF;
  TCNT1 = 0;
  TIFR1 = _BV(OCF1A) | _BV(OCF1B);
  TIMSK1 = _BV(OCIE1A) | _BV(OCIE1B);
  SREG = old;
}

inline void end_pwm_pair() {
  TIMSK1 = 0;
  pwm_cycle = 0;
  for (volatile PwmChannel &channel : pwm_channels) {
    channel.high = false;
    if (channel.out) Io(channel.pin).drive(false);
  }
}

//# helper PwmDevice
struct PwmDevice {
  uint32_t cycle_us, asked_us[2];
  uint16_t cycle;                 // ticks of Timer1
  uint16_t begun;                 // when the present cycle did
  uint16_t asked[2], high[2];     // ticks of Timer1, from the next cycle on and in this one
  uint8_t channels;               // bit for each channel in use
  uint8_t open;                   // bit for each channel whose pulse is still to end
  uint8_t mask[2];
  volatile uint8_t *out[2];
  uint8_t pin[2];
};

//# helper pwm_devices
//#   needs: Io PwmDevice
//#   vector: TIMER1_COMPA_vect TIMER1_COMPB_vect
//#   timer: Timer1
//#   ram: 5
static PwmDevice *volatile pwm_running[2];
static uint8_t pwm_shift;  // a tick is 1 << shift cycles of the clock

inline uint16_t pwm_next(PwmDevice *device) {  // does what is due, and tells when the next thing is
  for (;;) {
    uint8_t place = device->open == 3 ? device->high[1] < device->high[0] : device->open >> 1;
    uint16_t due = device->open ? device->high[place] : device->cycle, passed = TCNT1 - device->begun;
    if (passed < due && due - passed > 64U >> pwm_shift) return device->begun + due;
    while ((uint16_t)(TCNT1 - device->begun) < due) {}
    if (device->open) {
      *device->out[place] &= ~device->mask[place];
      device->open &= ~(1 << place);
      continue;
    }
    device->begun += device->cycle;
    for (place = 0; place < 2; place++) {
      device->high[place] = device->asked[place];
      if (!(device->channels & 1 << place)) continue;
      if (!device->high[place]) {
        *device->out[place] &= ~device->mask[place];
        continue;
      }
      *device->out[place] |= device->mask[place];
      if (device->high[place] < device->cycle) device->open |= 1 << place;
    }
  }
}

ISR(TIMER1_COMPA_vect) { OCR1A = pwm_next(pwm_running[0]); }
ISR(TIMER1_COMPB_vect) { OCR1B = pwm_next(pwm_running[1]); }

inline uint16_t pwm_ticks(uint32_t microseconds) {
  uint64_t ticks = (uint64_t)microseconds * clockCyclesPerMicrosecond() >> pwm_shift;
  return min(ticks, (uint64_t)65000);
}

inline void begin_pwm(PwmDevice *device, uint32_t cycle) {
  const uint8_t shifts[] = {0, 0, 3, 6, 8, 10};
  uint8_t clock = 1, place = !pwm_running[0] ? 0 : 1;
  device->cycle_us = cycle;
  if (pwm_running[place]) return;
  if (pwm_running[!place]) clock = TCCR1B;
  while (clock < 5 && (uint64_t)cycle * clockCyclesPerMicrosecond() >> shifts[clock] > 65000) clock++;
  uint8_t old = SREG;
  cli();
  bool anew = TCCR1B != clock;
  pwm_running[place] = device;
  pwm_shift = shifts[clock];
  TCCR1A = 0;
  TCCR1B = clock;
  for (uint8_t number = 0; number < 2; number++) {
    PwmDevice *each = pwm_running[number];
    if (!each || (each != device && !anew)) continue;
    each->cycle = pwm_ticks(each->cycle_us);
    for (uint8_t channel = 0; channel < 2; channel++) each->asked[channel] = min(pwm_ticks(each->asked_us[channel]), each->cycle);
    each->open = 0;
    each->begun = TCNT1;
    if (number) OCR1B = each->begun + each->cycle;
    else OCR1A = each->begun + each->cycle;
    TIFR1 = number ? _BV(OCF1B) : _BV(OCF1A);
    TIMSK1 |= number ? _BV(OCIE1B) : _BV(OCIE1A);
  }
  SREG = old;
}

inline void set_pwm(PwmDevice *device, uint8_t place, const Io &io, int32_t high_us) {  // less than nothing: no more pulses
  uint8_t bit = 1 << place;
  uint8_t old = SREG;
  cli();
  if (device->channels & bit && (high_us < 0 || device->pin[place] != io.pin)) {
    device->channels &= ~bit;
    device->open &= ~bit;
    Io before(device->pin[place]);
    before.drive(false);
  }
  SREG = old;
  if (high_us < 0 || !io.wired()) return;
  uint16_t high = min(pwm_ticks(high_us), device->cycle);
  cli();
  device->asked_us[place] = high_us;
  device->asked[place] = high;
  if (!(device->channels & bit)) {
    digitalWrite(io.pin, LOW);
    io.set(false);
    io.drive_for_library();
  }
  device->pin[place] = io.pin;
  device->out[place] = io.out;
  device->mask[place] = io.mask;
  device->channels |= bit;
  SREG = old;
}

inline void end_pwm(PwmDevice *device) {
  for (uint8_t place = 0; place < 2; place++) set_pwm(device, place, Io(-1), -1);
  for (uint8_t place = 0; place < 2; place++) {
    if (pwm_running[place] != device) continue;
    TIMSK1 &= ~(place ? _BV(OCIE1B) : _BV(OCIE1A));
    pwm_running[place] = 0;
  }
  if (!pwm_running[0] && !pwm_running[1]) TCCR1B = 0;
}

// ---------------------------------------------------------------- two-wire bus

//# helper two_wire_command
//#   fidelity: gives the hardware a command and waits for it, 10 ms at most; then what it answers as its status
inline uint8_t two_wire_command(uint8_t command) {
  TWCR = _BV(TWINT) | _BV(TWEN) | command;
  delayMicroseconds(command & _BV(TWSTA) ? 10 : 90);  // that long it takes at least; some simulators leave TWINT set meanwhile
  for (uint16_t turn = 20000; turn && !(TWCR & _BV(TWINT)); turn--) {}
  return TWCR & _BV(TWINT) ? TWSR & 0xF8 : 0;
}

//# helper TwoWireBus
//#   needs: two_wire_command
struct TwoWireBus {  // the hardware drives the one at SCL and SDA; at any other pins there is no device
  bool wired;

  static uint8_t place(int32_t scl, int32_t sda) { return scl != SCL || sda != SDA; }  // of a table of two
  void open(int32_t scl, int32_t sda, int32_t frequency) {
    wired = scl == SCL && sda == SDA;
    if (!wired) return;
    digitalWrite(SCL, HIGH);
    digitalWrite(SDA, HIGH);
    TWSR = 0;
    int32_t half = (int32_t)(F_CPU / frequency - 16) / 2;
    TWBR = half > 255 ? 255 : half;
    TWCR = _BV(TWEN);
  }
  void close() {
    if (wired) TWCR = 0;
    wired = false;
  }
  void start() const {
    if (wired) two_wire_command(_BV(TWSTA));
  }
  void stop() const {
    if (!wired) return;
    TWCR = _BV(TWINT) | _BV(TWEN) | _BV(TWSTO);
    for (uint16_t turn = 20000; turn && TWCR & _BV(TWSTO); turn--) {}
  }
  bool write(uint8_t byte) const {  // whether it is acknowledged
    if (!wired) return false;
    TWDR = byte;
    uint8_t status = two_wire_command(0);
    return status == 0x18 || status == 0x28 || status == 0x40;  // an address to write to, a byte, an address to read from
  }
  uint8_t read(bool acknowledges) const {
    if (!wired) return 0;
    two_wire_command(acknowledges ? _BV(TWEA) : 0);
    return TWDR;
  }
};

// ---------------------------------------------------------------- serial lines

//# helper console
inline bool is_console(int32_t rxpin, int32_t txpin) { return rxpin == 0 && txpin == 1; }

inline bool console_is_sent() { return Serial.availableForWrite() == SERIAL_TX_BUFFER_SIZE - 1; }

//# helper console
//#   mcu: atmega32u4
//#   needs: Io
inline bool is_console(int32_t rxpin, int32_t txpin) {  // 254 stands for it
  return (rxpin == 254 || txpin == 254) && !Io(rxpin).wired() && !Io(txpin).wired();
}

inline bool console_is_sent() {  // after the wait for it: how much room there is tells nothing
  Serial.flush();
  return true;
}

//# helper wait_for_console
inline void wait_for_console(Stream &port, int32_t) { port.flush(); }

//# helper begin_console
inline void begin_console(uint32_t baud) { Serial.begin(baud); }

//# helper wait_for_console
//#   mcu: atmega32u4
//#   needs: simpletext.h/usb_console
inline void wait_for_console(Stream &port, int32_t bytes) { wait_for_usb(port, bytes); }

//# helper begin_console
//#   mcu: atmega32u4
//#   needs: simpletext.h/usb_console
inline void begin_console(uint32_t baud) { begin_usb(baud); }

//# helper SerialLine
//#   needs: Io PinWatch simpletools.h/TimedInput quiet_of_servos
//#   include: <util/delay_basic.h>
//#   fidelity: up to 19,200 baud a byte is put together from the times of its edges, so that other interrupts go on, and several lines
//#   fidelity: receive at the same time; faster, a byte is received and sent with interrupts off
//#   ram: 22
struct SerialLine : Stream, PinWatch {
  Io receives, sends;
  bool inverts_rx, inverts_tx, open_drain, drops_echo, fast;
  uint16_t cycles, bit_us;             // of a bit
  volatile uint8_t head = 0, tail = 0;
  uint8_t bytes[64];
  volatile uint8_t cells = 0;          // of the byte that comes: 0 none, else the start bit and those known
  uint8_t coming;
  uint32_t begun;                      // micros of its start bit

  SerialLine(int32_t rxpin, int32_t txpin, uint8_t mode, uint32_t baudrate)
      : receives(rxpin), sends(txpin), inverts_rx(mode & 1), inverts_tx(mode & 2), open_drain(mode & 4),
        drops_echo(mode & 8), fast(baudrate > 19200) {
    cycles = (F_CPU + baudrate / 2) / baudrate;
    bit_us = (1000000UL + baudrate / 2) / baudrate;
    if (receives.wired()) {
      receives.drive(false);
      if (!inverts_rx) receives.put(receives.out, true);  // a line that is not wired rests
    }
    if (sends.wired()) show(true);
  }
  virtual ~SerialLine() {
    end_watch(*this);
    receives.drive(false);
    sends.drive(false);
  }
  void show(bool mark) const {  // the line's level: 1 at rest
    bool level = mark != inverts_tx;
    if (!open_drain) {
      sends.put(sends.out, level);
      sends.put(sends.direction, true);
    } else if (mark) {
      sends.put(sends.direction, false);
      sends.put(sends.out, !inverts_tx);  // a pull-up
    } else {
      sends.put(sends.out, level);
      sends.put(sends.direction, true);
    }
  }
  void let_go() const { sends.put(sends.direction, false); }  // the latch is high: a pull-up
  void keep(uint8_t byte) {
    uint8_t next = (head + 1) & 63;
    if (next == tail) return;
    bytes[head] = byte;
    head = next;
  }
  void fill(uint16_t us, bool mark) {  // the line was at that level until so many microseconds after the start bit began
    for (; cells && us > (uint16_t)(cells * bit_us + bit_us / 2); cells++) {
      if (cells == 9) {
        keep(coming);
        cells = 0;
        return;
      }
      coming = coming >> 1 | (mark ? 0x80 : 0);
    }
  }
  static void fast_edge(PinWatch &watch) {  // right behind the beginning of a start bit, with interrupts off
    SerialLine &line = static_cast<SerialLine &>(watch);
    uint8_t rests = line.inverts_rx ? 0 : line.mask, byte = 0;
    if (line.level == rests) return;
    uint16_t bit = line.cycles / 4;
    _delay_loop_2(bit + bit / 2 - 38);
    for (uint8_t number = 0; number < 8; number++) {
      byte >>= 1;
      if ((*line.in & line.mask) == rests) byte |= 0x80;
      _delay_loop_2(bit - 5);
    }
    line.level = *line.in & line.mask;
    line.keep(byte);
  }
  static void edge(PinWatch &watch) {
    SerialLine &line = static_cast<SerialLine &>(watch);
    bool mark = (line.level != 0) != line.inverts_rx;
    uint32_t now = micros(), passed = now - line.begun;
    if (line.cells == 1 && passed < line.bit_us / 2) line.cells = 0;  // no start bit
    if (line.cells) line.fill(passed > 60000 ? 60000 : passed, !mark);
    if (line.cells || mark) return;
    line.begun = now;
    line.cells = 1;
  }
  virtual int available() {
    uint8_t old = SREG;
    cli();
    uint32_t passed = micros() - begun;
    if (cells && passed > bit_us * 9U + bit_us / 2U) fill(60000, (level != 0) != inverts_rx);  // its last bits were like the stop bit
    uint8_t count = (head - tail) & 63;
    SREG = old;
    return count;
  }
  virtual int peek() { return available() ? bytes[tail] : -1; }
  virtual int read() {
    if (!available()) return -1;
    uint8_t byte = bytes[tail];
    tail = (tail + 1) & 63;
    return byte;
  }
  virtual void flush() {}
  virtual size_t write(uint8_t byte) {
    if (!sends.wired()) return 1;
    if (frames_due) frames_due();
    frames_wait = 50;
    if (cycles < F_CPU / 9000) quiet_of_servos(bit_us * 10UL);
    uint16_t bits = byte << 1 | 0x200, until = 0;
    uint8_t old = SREG, last = head;
    cli();
    uint32_t start = micros();
    for (uint8_t left = 10; left; left--, bits >>= 1) {
      show(bits & 1);
      if (fast) {
        _delay_loop_2(cycles / 4 - 27);
        continue;
      }
      SREG = old;  // other interrupts have their time behind an edge, so that none runs when the next one is due
      uint16_t quiet = until + bit_us - 32;
      while (micros() - start < quiet) {}
      cli();
      until += bit_us;
      while (micros() - start < until) {}
    }
    frames_wait = 0;
    if (drops_echo) {
      head = last;
      cells = 0;
    }
    SREG = old;
    return 1;
  }
  using Print::write;
};

//# helper HalfDuplexLine
//#   needs: Io
//#   include: <util/delay_basic.h>
//#   fidelity: 19,200 baud both ways on one line that a pull-up holds high
struct HalfDuplexLine {
  Io io;

  explicit HalfDuplexLine(uint8_t pin) : io(pin) {
    if (io.wired()) release();
  }
  void release() const {
    io.put(io.direction, false);
    io.put(io.out, true);
  }
  void hold(uint8_t part) const { _delay_loop_2(part - 6); }  // units of 4 cycles; 6 for what stands around it
  static constexpr uint8_t whole = F_CPU / 19200 / 4;
  bool waits() const { return io.wired() && !io.high(); }  // a start bit is on the line
  void send(uint8_t byte) const {
    if (!io.wired()) return;
    uint8_t old = SREG;
    cli();
    for (uint16_t bits = byte << 1 | 0x200, left = 10; left; left--, bits >>= 1) {
      if (bits & 1) release();
      else {
        io.put(io.out, false);
        io.put(io.direction, true);
      }
      hold(whole - 4);
    }
    SREG = old;
  }
  uint8_t receive() const {  // right after the start bit began
    uint8_t old = SREG, byte = 0;
    cli();
    hold(whole / 2);
    for (uint8_t number = 0; number < 8; number++) {
      hold(whole);
      byte = byte >> 1 | (io.high() ? 0x80 : 0);
    }
    hold(whole);
    SREG = old;
    return byte;
  }
};

// ---------------------------------------------------------------- lights

//# helper LightLine
//#   needs: Io
//#   fidelity: bits of 20 cycles for lights that want 1.25 us: only at 16 MHz
struct LightLine {  // interrupts are off
  volatile uint8_t *out;
  uint8_t low, high;

  explicit LightLine(const Io &io) : out(io.out), low(*io.out & ~io.mask), high(low | io.mask) {}
  void send(uint8_t byte) const {
    uint8_t bits = 8, now;
    asm volatile(
        "1: st %a[out], %[high]\n\t"  // 2 cycles; the pin is high for 6 or 13 cycles of 20
        "mov %[now], %[low]\n\t"
        "sbrc %[byte], 7\n\t"
        "mov %[now], %[high]\n\t"
        "lsl %[byte]\n\t"
        "st %a[out], %[now]\n\t"
        "rjmp .+0\n\t"
        "rjmp .+0\n\t"
        "nop\n\t"
        "st %a[out], %[low]\n\t"
        "rjmp .+0\n\t"
        "dec %[bits]\n\t"
        "brne 1b"
        : [bits] "+r"(bits), [byte] "+r"(byte), [now] "=&r"(now)
        : [out] "e"(out), [high] "r"(high), [low] "r"(low));
  }
};

// ---------------------------------------------------------------- memory that lasts

//# helper store
//#   include: <avr/eeprom.h>
const uint32_t store_size = E2END + 1UL;

inline uint8_t store_read(uint32_t at) { return eeprom_read_byte((uint8_t *)(uint16_t)at); }

inline void store_write(uint32_t at, uint8_t value) { eeprom_update_byte((uint8_t *)(uint16_t)at, value); }

// ---------------------------------------------------------------- voltages

//# helper analog_counts
//#   fidelity: 4,096 counts of 5 V, in steps of 4
inline int32_t analog_counts(uint8_t pin) { return pin < NUM_DIGITAL_PINS ? analogRead(pin) * 4L : 0; }

//# helper output_volts
const float output_volts = 5.0f;  // of a pin that is high

// ---------------------------------------------------------------- files of the C library

//# helper own_files
//#   include: <stdio.h>
typedef FILE OwnFile;

inline FILE *open_own_file(OwnFile &file, int (*put)(char, FILE *), int (*get)(FILE *), void *about) {
  fdev_setup_stream(&file, put, get, _FDEV_SETUP_RW);
  fdev_set_udata(&file, about);
  return &file;
}

inline bool is_own_file(const OwnFile &file, const FILE *stream) { return &file == stream; }

inline void *about_own_file(FILE *file) { return fdev_get_udata(file); }

const int end_of_own_file = _FDEV_EOF;

// ---------------------------------------------------------------- cogs

//# helper stack_pointer
inline const uint8_t *stack_pointer() { return (const uint8_t *)SP; }

//# helper cog_frame
//#   fidelity: the registers that a function must keep, and its return address
const uint8_t cog_saved = 18, cog_room = 0;

inline uint8_t *cog_frame(uint8_t *top, void (*code)()) {  // what the stack pointer of a cog that begins is
  *--top = (uint16_t)code;
  *--top = (uint16_t)code >> 8;
#ifdef __AVR_3_BYTE_PC__
  *--top = 0;
#endif
  return top - cog_saved - 1;
}

//# helper cog_switch
//#   fidelity: keeps the registers that a function must keep, in 8 to 12 us
extern "C" void cog_switch(uint8_t **save, uint8_t *load) __attribute__((naked, noinline, used, weak));
void cog_switch(uint8_t **, uint8_t *) {
  asm volatile(
      ".irp r,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,28,29\n\tpush \\r\n\t.endr\n\t"
      "movw r30, r24\n\tin r24, __SP_L__\n\tin r25, __SP_H__\n\tst Z, r24\n\tstd Z+1, r25\n\t"
      "in r0, __SREG__\n\tcli\n\tout __SP_H__, r23\n\tout __SREG__, r0\n\tout __SP_L__, r22\n\t"  // what follows SREG is atomic
      ".irp r,29,28,17,16,15,14,13,12,11,10,9,8,7,6,5,4,3,2\n\tpop \\r\n\t.endr\n\t"
      "ret\n");
}

//# helper cog_overflow
//#   fidelity: a cog that used more than its stack stops the program, which says so on the console where that is open
inline void cog_overflow(uint8_t number) {
  noInterrupts();
#ifdef UCSR0B
  const char said[] = "\r\ncog 0: more stack than COG_STACK\r\n";
  for (uint8_t at = 0; UCSR0B & 1 << TXEN0 && said[at]; at++) {
    while (!(UCSR0A & 1 << UDRE0)) {
    }
    UDR0 = said[at] == '0' ? '0' + number : said[at];
  }
#endif
  (void)number;
  for (;;) {
  }
}

//# helper cog_heap
//#   fidelity: while a cog runs, the heap may grow as far as the stack of main lets it; weak, as most programs have no heap
extern char *__malloc_heap_end __attribute__((weak));
extern size_t __malloc_margin __attribute__((weak));

inline void cog_heap(bool leaves_main, bool enters_main) {  // without an end, malloc takes the stack in use for that of main
  if (!&__malloc_heap_end) return;
  if (leaves_main) __malloc_heap_end = (char *)SP - __malloc_margin;
  if (enters_main) __malloc_heap_end = 0;
}
