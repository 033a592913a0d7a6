//# header fdserial.h
// Serial lines at any pins, in C. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/TextDevices/libfdserial (fdserial.h,
// fdserial.c, fdserial_utils.c). The library has a cog for each; here pin-change interrupts receive, the program itself sends, and the
// USART is used at the pins of the console.

//# type fdserial
//#   needs: simpletext.h/text_t
//#   fidelity: a device of text; there are no cogid and devst
typedef text_t fdserial;

//# constant FDSERIAL_BUFF_MASK
//#   fidelity: exact
#define FDSERIAL_BUFF_MASK 0x3f

//# constant FDSERIAL_MODE_NONE
//#   fidelity: exact
#define FDSERIAL_MODE_NONE 0

//# constant FDSERIAL_MODE_INVERT_RX
//#   fidelity: exact
#define FDSERIAL_MODE_INVERT_RX 1

//# constant FDSERIAL_MODE_INVERT_TX
//#   fidelity: exact
#define FDSERIAL_MODE_INVERT_TX 2

//# constant FDSERIAL_MODE_OPENDRAIN_TX
//#   fidelity: exact
#define FDSERIAL_MODE_OPENDRAIN_TX 4

//# constant FDSERIAL_MODE_IGNORE_TX_ECHO
//#   fidelity: exact
#define FDSERIAL_MODE_IGNORE_TX_ECHO 8

//# constant FDSERIAL_MODE_RX_ONLY
//#   fidelity: exact
#define FDSERIAL_MODE_RX_ONLY 16

//# constant FDSERIAL_MODE_ECHO_RX_TO_TX
//#   fidelity: exact
#define FDSERIAL_MODE_ECHO_RX_TO_TX 32

//# helper PinWatch
//#   needs: simpletools.h/Io
//#   include: <avr/interrupt.h>
//#   fidelity: one handler of pin-change interrupts for all that waits for them
//#   ram: 2
typedef struct PinWatch {
  volatile uint8_t *in;  // the pin's register and bit
  uint8_t mask, level;
  void (*changed)(struct PinWatch *watch);
  struct PinWatch *next;
} PinWatch;
static PinWatch *pin_watches;

static inline void pins_changed(void) {
  for (PinWatch *watch = pin_watches; watch; watch = watch->next) {
    uint8_t level = *watch->in & watch->mask;
    if (level == watch->level) continue;
    watch->level = level;
    watch->changed(watch);
  }
}

static inline void end_watch(PinWatch *watch) {
  uint8_t old = SREG;
  cli();
  for (PinWatch **link = &pin_watches; *link; link = &(*link)->next) {
    if (*link != watch) continue;
    *link = watch->next;
    break;
  }
  SREG = old;
}

static inline bool begin_watch(PinWatch *watch, Io io, uint8_t group, volatile uint8_t *which, uint8_t bit, void (*changed)(PinWatch *watch)) {
  uint8_t old = SREG;
  cli();
  watch->in = io.in;
  watch->mask = io.mask;
  watch->level = *io.in & io.mask;
  watch->changed = changed;
  watch->next = pin_watches;
  pin_watches = watch;
  *which |= bit;
  PCICR |= _BV(group);
  SREG = old;
  return true;
}

//# helper watch_pin
//#   needs: PinWatch
//#   vector: PCINT0_vect PCINT1_vect PCINT2_vect
static inline bool watch_pin(PinWatch *watch, Io io, void (*changed)(PinWatch *watch)) {  // false: no such interrupt
  uint8_t port = io.number >> 3;
  if (port == 1) return begin_watch(watch, io, 0, &PCMSK0, io.mask, changed);
#ifdef PORTJ
  if (port == 9 && io.mask < 0x80) return begin_watch(watch, io, 1, &PCMSK1, io.mask << 1, changed);
  if (port == 4 && io.mask == 1) return begin_watch(watch, io, 1, &PCMSK1, 1, changed);
  if (port == 10) return begin_watch(watch, io, 2, &PCMSK2, io.mask, changed);
#else
  if (port == 2) return begin_watch(watch, io, 1, &PCMSK1, io.mask, changed);
  if (port == 3) return begin_watch(watch, io, 2, &PCMSK2, io.mask, changed);
#endif
  return false;
}

ISR(PCINT0_vect) { pins_changed(); }
ISR(PCINT1_vect) { pins_changed(); }
ISR(PCINT2_vect) { pins_changed(); }

//# helper watch_pin
//#   needs: PinWatch
//#   vector: PCINT0_vect
//#   mcu: atmega32u4
static inline bool watch_pin(PinWatch *watch, Io io, void (*changed)(PinWatch *watch)) {  // false: no such interrupt
  return io.number >> 3 == 1 && begin_watch(watch, io, 0, &PCMSK0, io.mask, changed);
}

ISR(PCINT0_vect) { pins_changed(); }

//# helper quiet_of_servos
//#   include: <avr/interrupt.h>
//#   needs: propeller.h/clock_us
//#   fidelity: waits until no pulse of a servo begins or ends for so many microseconds, at most a frame of 20 ms
static inline void quiet_of_servos(uint32_t us) {
  if (us > 15000) return;  // no frame has room for that
  const uint8_t counts = F_CPU / 8000000UL;  // of Timer1 in a microsecond
  uint16_t least = (us + 24) * counts;
  for (uint32_t begun = clock_us(); TIMSK1 & _BV(OCIE1A) && clock_us() - begun < 20000;) {
    uint8_t old = SREG;
    cli();
    uint16_t left = OCR1A - TCNT1;
    bool due = TIFR1 & _BV(OCF1A);
    SREG = old;
    if (!due && left > least && left <= 20000U * counts) return;
  }
}

//# helper SerialLine
//#   needs: PinWatch quiet_of_servos simpletools.h/Io simpletools.h/timed_input propeller.h/clock_us
//#   include: <stdlib.h>
//#   fidelity: a byte is put together from the times of its edges, so that other interrupts go on, and several lines receive at the
//#   fidelity: same time
typedef struct SerialLine {
  PinWatch watch;
  Io receives, sends;
  bool inverts_rx, inverts_tx, open_drain, drops_echo;
  uint16_t bit_us;                     // of a bit
  volatile uint8_t head, tail;
  uint8_t bytes[64];
  volatile uint8_t cells;              // of the byte that comes: 0 none, else the start bit and those known
  uint8_t coming;
  uint32_t begun;                      // clock_us of its start bit
} SerialLine;

static inline void line_show(const SerialLine *line, bool mark) {  // the line's level: 1 at rest
  bool level = mark != line->inverts_tx;
  if (!line->open_drain) {
    io_put(line->sends, IO_OUT, level);
    io_put(line->sends, IO_DIRECTION, true);
  } else if (mark) {
    io_put(line->sends, IO_DIRECTION, false);
    io_put(line->sends, IO_OUT, !line->inverts_tx);  // a pull-up
  } else {
    io_put(line->sends, IO_OUT, level);
    io_put(line->sends, IO_DIRECTION, true);
  }
}

static inline void line_keep(SerialLine *line, uint8_t byte) {
  uint8_t next = (line->head + 1) & 63;
  if (next == line->tail) return;
  line->bytes[line->head] = byte;
  line->head = next;
}

static inline void line_fill(SerialLine *line, uint16_t us, bool mark) {  // it was at that level until so many us after the start bit began
  for (; line->cells && us > (uint16_t)(line->cells * line->bit_us + line->bit_us / 2); line->cells++) {
    if (line->cells == 9) {
      line_keep(line, line->coming);
      line->cells = 0;
      return;
    }
    line->coming = line->coming >> 1 | (mark ? 0x80 : 0);
  }
}

static inline void line_edge(PinWatch *watch) {
  SerialLine *line = (SerialLine *)watch;
  bool mark = (watch->level != 0) != line->inverts_rx;
  uint32_t now = clock_us(), passed = now - line->begun;
  if (line->cells == 1 && passed < line->bit_us / 2) line->cells = 0;  // no start bit
  if (line->cells) line_fill(line, passed > 60000 ? 60000 : passed, !mark);
  if (line->cells || mark) return;
  line->begun = now;
  line->cells = 1;
}

static inline uint8_t line_count(SerialLine *line) {  // bytes that came
  uint8_t old = SREG;
  cli();
  uint32_t passed = clock_us() - line->begun;
  if (line->cells && passed > line->bit_us * 9U + line->bit_us / 2U)
    line_fill(line, 60000, (line->watch.level != 0) != line->inverts_rx);  // its last bits were like the stop bit
  uint8_t count = (line->head - line->tail) & 63;
  SREG = old;
  return count;
}

static inline int16_t line_get(SerialLine *line) {
  if (!line_count(line)) return -1;
  uint8_t byte = line->bytes[line->tail];
  line->tail = (line->tail + 1) & 63;
  return byte;
}

static inline void line_put(SerialLine *line, uint8_t byte) {
  if (!line->sends.mask) return;
  if (frames_due) frames_due();
  frames_wait = 50;
  if (line->bit_us < 111) quiet_of_servos(line->bit_us * 10UL);  // above 9,000 baud
  uint16_t bits = byte << 1 | 0x200, until = 0;
  uint8_t old = SREG, last = line->head;
  cli();
  uint32_t start = clock_us();
  for (uint8_t left = 10; left; left--, bits >>= 1) {
    line_show(line, bits & 1);
    SREG = old;  // other interrupts have their time behind an edge, so that none runs when the next one is due
    uint16_t quiet = until + line->bit_us - 32;
    while (clock_us() - start < quiet) {}
    cli();
    until += line->bit_us;
    while (clock_us() - start < until) {}
  }
  frames_wait = 0;
  if (line->drops_echo) {
    line->head = last;
    line->cells = 0;
  }
  SREG = old;
}

static inline void line_close(SerialLine *line) {
  end_watch(&line->watch);
  io_drive(line->receives, false);
  io_drive(line->sends, false);
  free(line);
}

//# helper is_console
static inline bool is_console(int32_t rxpin, int32_t txpin) { return rxpin == AVR_PIN('D', 0) && txpin == AVR_PIN('D', 1); }

//# helper is_console
//#   mcu: atmega2560
static inline bool is_console(int32_t rxpin, int32_t txpin) { return rxpin == AVR_PIN('E', 0) && txpin == AVR_PIN('E', 1); }

//# helper is_console
//#   mcu: atmega32u4
static inline bool is_console(int32_t rxpin, int32_t txpin) { return rxpin == AVR_PIN('D', 2) && txpin == AVR_PIN('D', 3); }

//# helper open_line
//#   needs: SerialLine watch_pin is_console simpletext.h/text_t simpletext.h/line_write simpletext.h/line_read simpletext.h/usart_registers
//#   fidelity: a device of text for a serial line at two pins, of which either may be none; at those of the console, the USART
static inline text_t *open_line(int32_t rxpin, int32_t txpin, int32_t mode, int32_t baudrate) {
  text_t *text = calloc(1, sizeof *text);
  text->terminalEcho = mode >> 4 & 1;
  if (is_console(rxpin, txpin)) {
    usart_open(baudrate);
    text->open = true;
    text->ecA = text->ecsA = '\r';
    text->ecB = '\n';
    return text;
  }
  Io receives = io_at(rxpin), sends = io_at(txpin);
  if (!receives.mask && !sends.mask) return text;
  SerialLine *line = text->line = calloc(1, sizeof *line);
  line_write = line_put;
  line_read = line_get;
  line->receives = receives;
  line->sends = sends;
  line->inverts_rx = mode & 1;
  line->inverts_tx = mode & 2;
  line->open_drain = mode & 4;
  line->drops_echo = mode & 8;
  line->bit_us = (1000000UL + baudrate / 2) / baudrate;
  if (receives.mask) {
    io_drive(receives, false);
    if (!line->inverts_rx) io_put(receives, IO_OUT, true);  // a line that is not wired rests
  }
  if (sends.mask) line_show(line, true);
  if (receives.mask) watch_pin(&line->watch, receives, line_edge);
  return text;
}

//# adapter fdserial_open
//#   for: fdserial *fdserial_open(int rxpin, int txpin, int mode, int baudrate)
//#   kind: semantic
//#   needs: fdserial open_line propeller.h/clock_wait
//#   pin: rxpin interrupt in
//#   pin: txpin digital out
//#   fidelity: 63 bytes are kept, as there; it waits half a second, as there; the modes for inversion, open drain and echo are obeyed
//#   limit: up to 19,200 baud away from the console
//#   limit: a byte is sent while the program waits, and what arrives meanwhile may get lost
//#   limit: beside servos a byte waits for a time between their pulses; below 9,600 baud it does not, and they are up to 40 us longer
//#   limit: FDSERIAL_MODE_RX_ONLY changes nothing
//#   range: baudrate 245..19200 away from RX: bytes get lost or broken
static inline fdserial *fdserial_open(int32_t rxpin, int32_t txpin, int32_t mode, int32_t baudrate) {
  fdserial *line = open_line(rxpin, txpin, mode, baudrate);
  clock_wait(500);
  return line;
}

//# adapter fdserial_rxCount
//#   for: int fdserial_rxCount(fdserial *term)
//#   kind: oneToOne
//#   needs: fdserial SerialLine simpletext.h/text_t simpletext.h/usart_registers
//#   fidelity: exact
static inline int32_t fdserial_rxCount(fdserial *term) {
  if (term->line) return line_count(term->line);
  return term->open ? (uint8_t)(usart_next - usart_first) % usart_room : 0;
}

//# adapter fdserial_rxReady
//#   for: int fdserial_rxReady(fdserial *term)
//#   kind: oneToOne
//#   needs: fdserial fdserial_rxCount
//#   fidelity: exact
static inline int32_t fdserial_rxReady(fdserial *term) {
  return fdserial_rxCount(term) != 0;
}

//# adapter fdserial_rxPeek
//#   for: int fdserial_rxPeek(fdserial *term)
//#   kind: oneToOne
//#   needs: fdserial fdserial_rxCount
//#   fidelity: exact: 0 without a byte
static inline int32_t fdserial_rxPeek(fdserial *term) {
  if (!fdserial_rxCount(term)) return 0;
  return term->line ? term->line->bytes[term->line->tail] : usart_bytes[usart_first];
}

//# adapter fdserial_rxCheck
//#   for: int fdserial_rxCheck(fdserial *term)
//#   kind: oneToOne
//#   needs: fdserial fdserial_rxCount
//#   fidelity: exact: -1 without a byte
static inline int32_t fdserial_rxCheck(fdserial *term) {
  return term->line ? line_get(term->line) : term->open ? usart_get() : -1;
}

//# adapter fdserial_rxChar
//#   for: int fdserial_rxChar(fdserial *term)
//#   kind: oneToMany
//#   needs: fdserial fdserial_rxCheck
//#   fidelity: exact: it waits for a byte
//#   limit: 0 at once where the line is not wired
static inline int32_t fdserial_rxChar(fdserial *term) {
  if (!term->line && !term->open) return 0;
  int32_t byte;
  while ((byte = fdserial_rxCheck(term)) < 0) {}
  return byte;
}

//# adapter fdserial_rxTime
//#   for: int fdserial_rxTime(fdserial *term, int ms)
//#   kind: oneToMany
//#   needs: fdserial fdserial_rxCheck propeller.h/clock_ms
//#   fidelity: exact: -1 when no byte comes in that time
static inline int32_t fdserial_rxTime(fdserial *term, int32_t ms) {
  int32_t byte;
  for (uint32_t begun = clock_ms(); (byte = fdserial_rxCheck(term)) < 0 && (int32_t)(clock_ms() - begun) <= ms;) {}
  return byte;
}

//# adapter fdserial_rxFlush
//#   for: void fdserial_rxFlush(fdserial *term)
//#   kind: oneToMany
//#   needs: fdserial fdserial_rxCheck
//#   fidelity: exact
static inline void fdserial_rxFlush(fdserial *term) {
  while (fdserial_rxCheck(term) >= 0) {}
}

//# adapter fdserial_txChar
//#   for: int fdserial_txChar(fdserial *term, int txbyte)
//#   kind: oneToOne
//#   needs: fdserial SerialLine simpletext.h/writeByte
//#   fidelity: exact; the answer is -1, as there without echo
static inline int32_t fdserial_txChar(fdserial *term, int32_t txbyte) {
  writeByte(term, txbyte);
  return -1;
}

//# adapter fdserial_txFlush
//#   for: void fdserial_txFlush(fdserial *term)
//#   kind: oneToOne
//#   needs: fdserial simpletext.h/usart_registers
//#   fidelity: exact: it waits until all is sent
static inline void fdserial_txFlush(fdserial *term) {
  if (term->open) usart_flush();
}

//# adapter fdserial_txEmpty
//#   for: int fdserial_txEmpty(fdserial *term)
//#   kind: oneToOne
//#   needs: fdserial simpletext.h/usart_registers
//#   fidelity: exact; away from the console nothing ever waits, as bytes are sent at once
static inline int32_t fdserial_txEmpty(fdserial *term) {
  return !term->open || usart_is_free();
}

//# adapter fdserial_close
//#   for: void fdserial_close(fdserial *term)
//#   kind: oneToMany
//#   needs: fdserial SerialLine fdserial_rxFlush fdserial_txFlush
//#   fidelity: what was to be sent is sent, then the pins are inputs and nothing more is received
static inline void fdserial_close(fdserial *term) {
  fdserial_rxFlush(term);
  fdserial_txFlush(term);
  if (term->open) usart_close();
  else if (term->line) line_close(term->line);
  free(term);
}
