//# header fdserial.h
// Serial lines at any pins. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/TextDevices/libfdserial (fdserial.h, fdserial.c,
// fdserial_utils.c). The library has a cog for each; here pin-change interrupts receive, the program itself sends, and Serial is used at
// the pins of the console.

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

//# helper SerialLine
//#   needs: simpletools.h/Io simpletools.h/PinWatch simpletools.h/TimedInput simpletools.h/quiet_of_servos
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

//# helper open_line
//#   needs: SerialLine simpletext.h/text_t simpletools.h/watch_pin
//#   fidelity: a device of text for a serial line at two pins, of which either may be none; at those of the console, Serial
inline text_t *open_line(int32_t rxpin, int32_t txpin, int32_t mode, int32_t baudrate) {
  text_t *line = new text_t();
  line->terminalEcho = mode >> 4 & 1;
  if (rxpin == 0 && txpin == 1) {
    Serial.begin(baudrate);
    line->port = &Serial;
    line->ecA = line->ecsA = '\r';
    line->ecB = '\n';
    return line;
  }
  bool receives = rxpin >= 0 && rxpin < NUM_DIGITAL_PINS, sends = txpin >= 0 && txpin < NUM_DIGITAL_PINS;
  if (receives || sends) {
    SerialLine *port = new SerialLine(rxpin, txpin, mode, baudrate);
    if (receives) watch_pin(*port, rxpin, port->fast ? SerialLine::fast_edge : SerialLine::edge);
    line->port = port;
  }
  return line;
}

//# adapter fdserial_open
//#   for: fdserial *fdserial_open(int rxpin, int txpin, int mode, int baudrate)
//#   kind: semantic
//#   needs: fdserial open_line
//#   pin: rxpin interrupt in
//#   pin: txpin digital out
//#   fidelity: 63 bytes are kept, as there; it waits half a second, as there; the modes for inversion, open drain and echo are obeyed
//#   limit: up to 57,600 baud away from the console, beside servos up to 19,200 and beside their feedback signals up to 9,600 baud
//#   limit: a byte is sent while the program waits, and what arrives meanwhile may get lost
//#   limit: beside servos a byte waits for a time between their pulses; below 9,600 baud it does not, and they are up to 40 us longer
//#   limit: FDSERIAL_MODE_RX_ONLY changes nothing
//#   range: baudrate 245..57600 away from RX: bytes get lost or broken
//#   range: baudrate 245..19200 beside servo.h/ServoSlot away from RX: the interrupts of servos break bytes
//#   range: baudrate 245..9600 beside servo360.h/feedback360_edge away from RX: the interrupts of feedback signals break bytes
//#   stack: 23 8
//#   interrupt: PCINT0_vect 41
//#   interrupt: PCINT1_vect 58
//#   interrupt: PCINT2_vect 58
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline fdserial *fdserial_open(int32_t rxpin, int32_t txpin, int32_t mode, int32_t baudrate) {
  fdserial *line = open_line(rxpin, txpin, mode, baudrate);
  delay(500);
  return line;
}

//# adapter fdserial_rxCount
//#   for: int fdserial_rxCount(fdserial *term)
//#   kind: oneToOne
//#   needs: fdserial simpletext.h/text_t
//#   fidelity: exact
//#   stack: 2 0
inline int32_t fdserial_rxCount(fdserial *term) {
  return term->port ? term->port->available() : 0;
}

//# adapter fdserial_rxReady
//#   for: int fdserial_rxReady(fdserial *term)
//#   kind: oneToOne
//#   needs: fdserial fdserial_rxCount
//#   fidelity: exact
//#   stack: 0
inline int32_t fdserial_rxReady(fdserial *term) {
  return fdserial_rxCount(term) != 0;
}

//# adapter fdserial_rxPeek
//#   for: int fdserial_rxPeek(fdserial *term)
//#   kind: oneToOne
//#   needs: fdserial fdserial_rxCount simpletext.h/text_t
//#   fidelity: exact: 0 without a byte
//#   stack: 4 0
inline int32_t fdserial_rxPeek(fdserial *term) {
  return fdserial_rxCount(term) ? term->port->peek() : 0;
}

//# adapter fdserial_rxCheck
//#   for: int fdserial_rxCheck(fdserial *term)
//#   kind: oneToOne
//#   needs: fdserial fdserial_rxCount simpletext.h/text_t
//#   fidelity: exact: -1 without a byte
//#   stack: 4 0
inline int32_t fdserial_rxCheck(fdserial *term) {
  return fdserial_rxCount(term) ? term->port->read() : -1;
}

//# adapter fdserial_rxChar
//#   for: int fdserial_rxChar(fdserial *term)
//#   kind: oneToMany
//#   needs: fdserial fdserial_rxCheck simpletext.h/text_t
//#   fidelity: exact: it waits for a byte
//#   limit: 0 at once where the line is not wired
//#   stack: 4 0
inline int32_t fdserial_rxChar(fdserial *term) {
  if (!term->port) return 0;
  int32_t byte;
  while ((byte = fdserial_rxCheck(term)) < 0) yield();
  return byte;
}

//# adapter fdserial_rxTime
//#   for: int fdserial_rxTime(fdserial *term, int ms)
//#   kind: oneToMany
//#   needs: fdserial fdserial_rxCheck
//#   fidelity: exact: -1 when no byte comes in that time
//#   stack: 14 0
inline int32_t fdserial_rxTime(fdserial *term, int32_t ms) {
  int32_t byte;
  for (uint32_t begun = millis(); (byte = fdserial_rxCheck(term)) < 0 && (int32_t)(millis() - begun) <= ms;) yield();
  return byte;
}

//# adapter fdserial_rxFlush
//#   for: void fdserial_rxFlush(fdserial *term)
//#   kind: oneToMany
//#   needs: fdserial fdserial_rxCheck
//#   fidelity: exact
//#   stack: 4 0
inline void fdserial_rxFlush(fdserial *term) {
  while (fdserial_rxCheck(term) >= 0) {}
}

//# adapter fdserial_txChar
//#   for: int fdserial_txChar(fdserial *term, int txbyte)
//#   kind: oneToOne
//#   needs: fdserial simpletext.h/text_t
//#   fidelity: exact; the answer is -1, as there without echo
//#   stack: 0
inline int32_t fdserial_txChar(fdserial *term, int32_t txbyte) {
  if (term->port) term->port->write((uint8_t)txbyte);
  return -1;
}

//# adapter fdserial_txFlush
//#   for: void fdserial_txFlush(fdserial *term)
//#   kind: oneToOne
//#   needs: fdserial simpletext.h/text_t
//#   fidelity: exact: it waits until all is sent
//#   stack: 2 0
inline void fdserial_txFlush(fdserial *term) {
  if (term->port) term->port->flush();
}

//# adapter fdserial_txEmpty
//#   for: int fdserial_txEmpty(fdserial *term)
//#   kind: oneToOne
//#   needs: fdserial simpletext.h/text_t
//#   fidelity: exact; away from the console nothing ever waits, as bytes are sent at once
//#   stack: 6
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t fdserial_txEmpty(fdserial *term) {
  return term->port != &Serial || Serial.availableForWrite() == SERIAL_TX_BUFFER_SIZE - 1;
}

//# adapter fdserial_close
//#   for: void fdserial_close(fdserial *term)
//#   kind: oneToMany
//#   needs: fdserial SerialLine fdserial_rxFlush fdserial_txFlush simpletext.h/text_t
//#   fidelity: what was to be sent is sent, then the pins are inputs and nothing more is received
//#   stack: 8 6
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void fdserial_close(fdserial *term) {
  fdserial_rxFlush(term);
  fdserial_txFlush(term);
  if (term->port == &Serial) Serial.end();
  else delete static_cast<SerialLine *>(term->port);
  delete term;
}
