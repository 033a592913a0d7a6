// Adapters for Arduino Uno: what the program uses of propeller, with the signatures and widths it had there.
#pragma once

#include <Arduino.h>
#include <math.h>
#include <Servo.h>

// OUTA and DIRA are independent on the Propeller and a released pin floats. PORT = 1 at an input of an AVR is a pull-up, so the
// output latch is kept here, and reaches PORT only while the pin is an output.
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

inline void drive_level(int32_t pin, bool value) {
  Io io(pin);
  if (!io.wired()) return;
  digitalWrite(io.pin, value);  // which ends a wave of a timer there
  io.set(value);
  io.drive(true);
}

// void low(int pin)
// Exact
inline void low(int32_t pin) {
  drive_level(pin, false);
}

// What tone() can play within 1 %
inline bool in_range_of_tone(int32_t frequency) {
  return frequency >= 31 && frequency <= 65535L;
}

// void freqout(int pin, int msTime, int frequency)
// 1 % in frequency from 31 Hz up to 65 kHz; the burst ends with the call and the pin as an input
// Limit: one tone at a time; below 31 Hz and above 65,535 Hz it waits without a tone
// Limit: beside servos some half periods are up to 24 us longer: of 1 ms at 38 kHz one cycle of 38 may lack
inline void freqout(int32_t pin, int32_t msTime, int32_t frequency) {
  Io io(pin);
  if (!io.wired() || !in_range_of_tone(frequency)) {
    delay((uint32_t)msTime);
    return;
  }
  low(pin);
  tone(io.pin, (unsigned int)frequency);
  delay((uint32_t)msTime);
  noTone(io.pin);
  io.drive(false);
}

// ---------------------------------------------------------------- waves that go on

// The pin that asks and the one that answers, of a component with a wire for each direction; else the pin itself is both
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

// The unit of timed input and output in ticks of 12.5 ns
static int32_t io_ticks = 80;

// What drives and servos calculate every 20 ms waits while an input is timed: up to 20 ms for the edge that begins it, and up
// to 20 ms for the one that ends it
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

// void pulse_out(int pin, int time)
// Within 0.5 us or 1 %; the pulse is the inverse of the output latch
inline void pulse_out(int32_t pin, int32_t time) {
  Io io(pin);
  if (!io.wired()) return;
  uint32_t width = io_ticks == 80 ? (uint32_t)time : (uint32_t)time * io_ticks / 80;
  io.drive(true);
  if (frames_due) frames_due();
  frames_wait = 20;
  uint8_t old = SREG;
  cli();
  if (width < 40) {
    *io.in = io.mask;  // a one written to PINx inverts PORTx
    delayMicroseconds(width);
    *io.in = io.mask;
    frames_wait = 3;  // what answers to the pulse may be timed next
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
  frames_wait = 3;
  SREG = old;
}

// Micros() moves in steps of 4 us; counting up to the next step of Timer0 makes an edge known to 6 cycles
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

// An edge is known to 1 us; one that came while an interrupt ran, to half of the time that it took
inline bool leaves(const Io &io, uint8_t level, uint32_t begun, uint32_t limit, uint32_t &at) {  // waits while the pin has the level
  uint16_t burst = limit > 20000 ? 2000 : 60;  // the clock is looked at rarely: that costs 4 us
  uint8_t tick = TCNT0, now, turns = 0;         // the last look with that level: so many turns of 14 cycles behind that step of Timer0
  do {
    for (uint16_t turn = burst; turn; turn--) {
      now = TCNT0;
      if ((*io.in & io.mask) != level) {
        at = edge_cycles();
        at -= (uint16_t)((uint16_t)at - tick * 64u - turns * 14u) % 16384 / 2;
        return true;
      }
      turns++;
      if (now == tick) continue;
      tick = now;
      turns = 0;
    }
  } while (micros() - begun < limit);
  at = edge_cycles();
  return false;
}

inline int32_t in_units(uint32_t cycles) {
  uint32_t micros_ = (cycles + clockCyclesPerMicrosecond() / 2) / clockCyclesPerMicrosecond();
  return io_ticks == 80 ? micros_ : micros_ * 80 / io_ticks;
}

// How long timed input waits, in ticks of 12.5 ns
static int32_t io_timeout_ticks = 20000000L;

// int pulse_in(int pin, int state)
// Within 2 us; 0 when no pulse begins in time, the part seen when it does not end
// Limit: an edge within an interrupt is known to half of its time: 12 us beside servos, 22 us where interrupts meet, 32 us with
// feedback
// Limit: other cogs wait meanwhile
inline int32_t pulse_in(int32_t pin, int32_t state) {
  Io io(pin);
  if (!io.wired()) return 0;
  io.drive(false);
  TimedInput timed;
  uint8_t level = state ? io.mask : 0, other = io.mask ^ level;
  uint32_t limit = (uint32_t)io_timeout_ticks / 80, begun = micros(), from, to;
  if (!leaves(io, level, begun, limit, from) || !leaves(io, other, begun, limit, from)) return 0;
  timed.edge_found();
  leaves(io, level, begun, limit, to);
  return in_units(to - from);
}

// int ping(int pin)
// Microseconds of the echo; 0 without an echo
inline int32_t ping(int32_t pin) {
  int32_t out = asking(pin);
  delay(1);
  low(out);
  pulse_out(out, 10);
  return pulse_in(answering(pin), 1);
}

// int ping_cm(int pin)
// Whole centimetres, rounded down
inline int32_t ping_cm(int32_t pin) {
  return ping(pin) / 58;
}

// For use with the functions; there are no rxChar, txChar, cogid and devst
struct text_t {
  Stream *port;
  int32_t terminalEcho;
  char ecA, ecB;    // these end a line when they are written
  char ecsA, ecsB;  // and this is sent then; 0 for nothing
  bool waits;       // until a byte is sent: the terminal does, lines that a cog sends do not
};

static text_t console = {&Serial, 0, '\r', '\n', '\n', 0, true};

// Exact: the device of print and its like, 0 when it is closed
static text_t *dport_ptr = &console;

// One that ends a line is sent as the device's line end; it does not wait
inline void sendByte(text_t *device, char c) {
  if (device && device->port) device->port->write((uint8_t)c);
}

inline void sendChar(text_t *device, char c) {
  if (!device) return;
  if (c != device->ecA && c != device->ecB) return sendByte(device, c);
  if (device->ecsA) sendByte(device, device->ecsA);
  if (device->ecsB) sendByte(device, device->ecsB);
}

inline void waitSent(text_t *device) {  // the program goes on when the terminal has its text, as there
  if (device && device->port && device->waits) device->port->flush();
}

// Where a text goes, a device or memory; it counts its characters. A character 0 ends what a device gets, as there
struct TextOut {
  text_t *device;
  char *memory;
  int32_t count, room;  // what does not fit is counted, too
  bool ended;

  explicit TextOut(text_t *to) : device(to), memory(0), count(0), room(0), ended(false) {}
  explicit TextOut(char *to, int32_t size = 32767) : device(0), memory(to), count(0), room(size), ended(false) {}
  ~TextOut() { waitSent(device); }
  void put(char c) {
    if (memory && count < room) memory[count] = c;
    else if (memory) ended = true;
    else if (!c) ended = true;
    else if (!ended) sendChar(device, c);
    count++;
  }
  void put(const char *text) {
    while (*text) put(*text++);
  }
  void fill(int32_t times, char c) {
    for (; times > 0; times--) put(c);
  }
  void number(uint32_t value, uint8_t base, int32_t width, char filler) {
    char digits[33], *first = digits + 32;
    *first = 0;
    do *--first = "0123456789abcdef"[value % base];
    while (value /= base);
    fill(width - (digits + 32 - first), filler);
    put(first);
  }
};

// An argument of print as it is there: 32 bits of integer, a float or a text
struct TextArgument {
  char kind;  // 'd', 'f' or 's'
  union {
    int32_t integer;
    float real;
    const char *text;
  };

  TextArgument() : kind('d'), integer(0) {}
  TextArgument(const char *value) : kind('s'), text(value) {}
  TextArgument(char *value) : kind('s'), text(value) {}
  TextArgument(const unsigned char *value) : kind('s'), text((const char *)value) {}
  TextArgument(unsigned char *value) : kind('s'), text((const char *)value) {}
  TextArgument(float value) : kind('f'), real(value) {}
  TextArgument(double value) : kind('f'), real((float)value) {}
  TextArgument(char value) : kind('d'), integer((uint8_t)value) {}  // plain char has no sign there
  template <class Pointed>
  TextArgument(Pointed *value) : kind('d'), integer((int32_t)(uint16_t)value) {}
  template <class Integer>
  TextArgument(Integer value) : kind('d'), integer((int32_t)value) {}

  int32_t number() const { return kind == 'f' ? (int32_t)real : integer; }
};

// char *float2string(float f, char *s, int width, int precision)
// Exact, digit by digit in the same steps: 6 decimal places at most, and a carry does not add a digit, so that 9.96 with one
// place is 0.0
inline char *float2string(float f, char *s, int32_t width, int32_t precision) {
  if (isnan(f)) return strcpy(s, "nan");
  if (isinf(f)) return strcpy(s, f < 0 ? "-inf" : "inf");
  uint8_t places = precision > 6 ? 6 : precision < 0 ? 0 : precision;
  char text[52], *end = text;
  if (f < 0) *end++ = '-';
  f = fabs(f);
  if (f < 1) {
    *end++ = '0';
  } else {
    int exponent;
    frexp(f, &exponent);
    float scale = 1000;
    for (exponent = (exponent - 1) / 10; exponent > 0; exponent--) scale *= 1000;
    while (scale > f) scale /= 10;
    for (; scale >= 1; scale /= 10) {
      uint8_t digit = (uint8_t)(f / scale);
      f -= digit * scale;
      *end++ = '0' + digit;
    }
  }
  int32_t padding = width - (end - text) - places - (places ? 1 : 0);
  if (places) *end++ = '.';
  for (uint8_t place = 0; place <= places; place++) {
    f *= 10;
    *end++ = '0' + (uint8_t)f;
    f -= (uint8_t)f;
  }
  bool carry = *--end >= '5';
  *end = 0;
  while (carry && end-- > text) {
    if (!isdigit((uint8_t)*end)) continue;
    carry = *end == '9';
    *end = carry ? '0' : *end + 1;
  }
  char *at = s;
  while (padding-- > 0) *at++ = ' ';
  strcpy(at, text);
  return s;
}

// %d %u %x %b %c %s %f %%, with a 0, a width and a precision. As there, a text has no width, a minus sign comes before the
// padding, and what is not known prints nothing and takes no argument
template <bool floats>
inline int32_t format_text(TextOut out, const char *format, const TextArgument *given, uint8_t count) {
  const TextArgument none, *last = given + count;
  for (; *format; format++) {
    if (*format != '%') {
      out.put(*format);
      continue;
    }
    char filler = *++format == '0' ? '0' : ' ';
    int32_t width = 0, precision = 6;
    for (; isdigit((uint8_t)*format); format++) width = 10 * width + (*format - '0');
    if (*format == '.')
      for (precision = 0; isdigit((uint8_t)*++format);) precision = 10 * precision + (*format - '0');
    if (!*format) break;
    if (*format == '%') out.put('%');
    if (!strchr(floats ? "bcdfsux" : "bcdsux", *format)) continue;
    const TextArgument &argument = given < last ? *given++ : none;
    int32_t number = argument.number();
    switch (*format) {
      case 'c': out.put((char)number); break;
      case 's': out.put(argument.kind == 's' ? argument.text : ""); break;
      case 'b': out.number(number, 2, width, filler); break;
      case 'x': out.number(number, 16, width, filler); break;
      case 'u': out.number(number, 10, width, filler); break;
      case 'd':
        if (number < 0) out.put('-');
        out.number(labs(number), 10, width - (number < 0), filler);
        break;
      default:
        char text[72];
        out.put(float2string(argument.kind == 'f' ? argument.real : number, text, width > 20 ? 20 : width, precision));
    }
  }
  if (out.memory) out.memory[out.count] = 0;
  return out.count;
}

// int print(const char *format, ...)
// Exact but for line ends, in 32 bits; texts of more than 255 characters, which overflow a buffer there, are printed
template <class... Arguments>
inline int32_t print(const char *format, Arguments... given) {
  const TextArgument arguments[] = {TextArgument(), given...};
  return format_text<true>(TextOut(dport_ptr), format, arguments + 1, sizeof...(given));
}

// The timer with which Servo.h makes its pulses: it counts half microseconds (at 16 MHz) from the begin of a frame
#define SERVO_COUNT TCNT1
#define SERVO_BEGIN OCR1A  // when Servo.h begins its next frame, while it makes no pulse
#define SERVO_JOB OCR1B    // when the frame jobs are due
#define SERVO_MASK TIMSK1
#define SERVO_PENDING TIFR1
#define SERVO_CLOCK TCCR1B
#define SERVO_MODE TCCR1A

const uint16_t frame_ticks = clockCyclesPerMicrosecond() * 2500UL;  // 20 ms
const uint16_t job_ticks = frame_ticks / 10 * 9;                    // jobs are 2 ms earlier than pulses

inline bool servo_pulses() { return SERVO_MASK & _BV(OCIE1A); }  // whether Servo.h makes any

// Servo.h makes pulses for at most 12 servos with one timer, the library for 14 with a cog
const uint8_t servo_places = MAX_SERVOS < 14 ? MAX_SERVOS : 14;

struct ServoSlot {
  Servo *servo;                // made once: each one counts as a channel of Servo.h from then on
  uint8_t pin;
  bool used, own;              // own: of a drive, which servo_stop and the like leave alone
  int16_t asked, sent, step;   // microseconds; step: at most so many more or less each frame

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
  void release() {
    if (servo->attached()) rest();
    Io(pin).drive(false);
  }
};
static ServoSlot servo_slots[servo_places];

inline ServoSlot *servo_slot(int32_t pin, bool make) {
  ServoSlot *free = 0;
  for (auto &slot : servo_slots) {
    if (slot.used && slot.pin == pin) return &slot;
    if (!slot.used && !free) free = &slot;
  }
  if (!make || !free) return 0;
  if (!free->servo) free->servo = new Servo;
  free->pin = pin;
  free->own = false;
  free->step = 2000;
  free->used = true;
  return free;
}

// int servo_set(int pin, int time)
// Widths within 1 us; returns the pin (the target's) at the first call, 1 later, -3 without a free place, as there; 0 us ends
// the pulses
// Limit: 12 servos at a time instead of 14, and no PWM on pins 9 and 10 of an Uno
// Limit: widths from 40 to 2,900 us
inline int32_t servo_set(int32_t pin, int32_t time) {
  if (!Io(pin).wired()) return 0;
  ServoSlot *slot = servo_slot(pin, false);
  int32_t known = slot ? 1 : pin;
  if (!time) {
    if (slot) {
      slot->release();
      slot->used = false;
    }
    return known;
  }
  if (!slot) {
    slot = servo_slot(pin, true);
    if (!slot) return -3;
    slot->sent = time;
  }
  uint8_t old = SREG;
  cli();
  slot->asked = time;
  SREG = old;
  for (auto &each : servo_slots)  // those that servo_stop has ended go on, as they do when the library's cog starts again
    if (each.used && !each.own && !each.servo->attached()) each.start(each.sent);
  if (slot->step >= 2000) slot->servo->writeMicroseconds(slot->sent = time);
  return known;
}

// int servo_angle(int pin, int degreeTenths)
// 500 us and one more for each tenth of a degree, as there
inline int32_t servo_angle(int32_t pin, int32_t degreeTenths) {
  return servo_set(pin, degreeTenths + 500);
}
