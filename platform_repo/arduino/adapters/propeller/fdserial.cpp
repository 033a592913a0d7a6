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

//# helper open_line
//#   needs: hal/SerialLine simpletext.h/text_t hal/watch_pin hal/console
//#   fidelity: a device of text for a serial line at two pins, of which either may be none; at those of the console, Serial
inline text_t *open_line(int32_t rxpin, int32_t txpin, int32_t mode, int32_t baudrate) {
  text_t *line = new text_t();
  line->terminalEcho = mode >> 4 & 1;
  if (is_console(rxpin, txpin)) {
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
//#   range: baudrate 245..19200 beside fdserial.h/fdserial_open away from RX: a line loses bytes while another one is busy
//#   range: baudrate 245..19200 beside servo.h/ServoSlot away from RX: the interrupts of servos break bytes
//#   range: baudrate 245..9600 beside servo360.h/feedback360_edge away from RX: the interrupts of feedback signals break bytes
//#   stack: 36 8
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
//#   needs: fdserial simpletext.h/text_t hal/console
//#   fidelity: exact; away from the console nothing ever waits, as bytes are sent at once
//#   stack: 6
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t fdserial_txEmpty(fdserial *term) {
  return term->port != &Serial || console_is_sent();
}

//# adapter fdserial_close
//#   for: void fdserial_close(fdserial *term)
//#   kind: oneToMany
//#   needs: fdserial hal/SerialLine fdserial_rxFlush fdserial_txFlush simpletext.h/text_t
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
