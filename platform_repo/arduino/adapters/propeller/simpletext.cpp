//# header simpletext.h
// Text on a terminal, on other devices and in memory. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/TextDevices/libsimpletext.
// The terminal is the serial port of the console. Its line ends are line feeds here and carriage returns there; control characters
// (HOME, CLS and so on) are sent as they are. Arguments of any type are taken as 32 bits, as there: no call has to be rewritten.
//# task _doscanf its values come in a list, with the widths of the calls that made it: call sprint, dprint or sscan with the values themselves
//# task _intscanf its values come in a list, with the widths of the calls that made it: call sprint, dprint or sscan with the values themselves

// ---------------------------------------------------------------- control characters

//# constant HOME
//#   fidelity: exact
//#   limit: the Serial Monitor of the Arduino IDE does not obey it; a Parallax terminal does
#define HOME 1L

//# constant CRSRXY
//#   fidelity: exact
//#   limit: the Serial Monitor of the Arduino IDE does not obey it; a Parallax terminal does
#define CRSRXY 2L

//# constant CRSRLF
//#   fidelity: exact
//#   limit: the Serial Monitor of the Arduino IDE does not obey it; a Parallax terminal does
#define CRSRLF 3L

//# constant CRSRRT
//#   fidelity: exact
//#   limit: the Serial Monitor of the Arduino IDE does not obey it; a Parallax terminal does
#define CRSRRT 4L

//# constant CRSRUP
//#   fidelity: exact
//#   limit: the Serial Monitor of the Arduino IDE does not obey it; a Parallax terminal does
#define CRSRUP 5L

//# constant CRSRDN
//#   fidelity: exact
//#   limit: the Serial Monitor of the Arduino IDE does not obey it; a Parallax terminal does
#define CRSRDN 6L

//# constant BEEP
//#   fidelity: exact
//#   limit: the Serial Monitor of the Arduino IDE does not obey it; a Parallax terminal does
#define BEEP 7L

//# constant BKSP
//#   fidelity: exact
//#   limit: the Serial Monitor of the Arduino IDE does not obey it; a Parallax terminal does
#define BKSP 8L

//# constant TAB
//#   fidelity: exact
#define TAB 9L

//# constant NL
//#   fidelity: exact
#define NL 10L

//# constant LF
//#   fidelity: exact
#define LF 10L

//# constant CLREOL
//#   fidelity: exact
//#   limit: the Serial Monitor of the Arduino IDE does not obey it; a Parallax terminal does
#define CLREOL 11L

//# constant CLRDN
//#   fidelity: exact
//#   limit: the Serial Monitor of the Arduino IDE does not obey it; a Parallax terminal does
#define CLRDN 12L

//# constant CR
//#   fidelity: exact
#define CR 13L

//# constant CRSRX
//#   fidelity: exact
//#   limit: the Serial Monitor of the Arduino IDE does not obey it; a Parallax terminal does
#define CRSRX 14L

//# constant CRSRY
//#   fidelity: exact
//#   limit: the Serial Monitor of the Arduino IDE does not obey it; a Parallax terminal does
#define CRSRY 15L

//# constant CLS
//#   fidelity: exact
//#   limit: the Serial Monitor of the Arduino IDE does not obey it; a Parallax terminal does
#define CLS 16L

//# constant ECHO_RX_TO_TX
//#   fidelity: exact
#define ECHO_RX_TO_TX 32L

// ---------------------------------------------------------------- devices

//# type text_t
//#   fidelity: for use with the functions; there are no rxChar, txChar, cogid and devst
struct text_t {
  Stream *port;
  int32_t terminalEcho;
  char ecA, ecB;    // these end a line when they are written
  char ecsA, ecsB;  // and this is sent then; 0 for nothing
  bool waits;       // until a byte is sent: the terminal does, lines that a cog sends do not
};

//# type text_t
//#   members: rxChar txChar cogid devst
//#   fidelity: devices of the program work through their own functions; those of adapters have a port and none
struct text_t {
  Stream *port;  // of adapters; 0 for a device of the program
  int32_t terminalEcho;
  char ecA, ecB;    // these end a line when they are written
  char ecsA, ecsB;  // and this is sent then; 0 for nothing
  bool waits;       // until a byte is sent: the terminal does, lines that a cog sends do not
  int32_t (*rxChar)(text_t *p);
  int32_t (*txChar)(text_t *p, int32_t ch);
  int32_t cogid[7];
  volatile void *devst;
};

//# type terminal
//#   needs: text_t
//#   fidelity: exact
typedef text_t terminal;

//# helper console
//#   needs: text_t
//#   setup: Serial.begin(115200);
//#   setup rp2040 renesas_uno teensy mbed_nano: while (!Serial && millis() < 3000) {}
//#   limit rp2040 renesas_uno teensy mbed_nano: what is printed before a computer opens the console would be lost: the program waits for that
//#   limit rp2040 renesas_uno teensy mbed_nano: without a computer it starts after 3 s, or after console_wait_ms of robosmi.toml
//#   ram: 11
static text_t console = {&Serial, 0, '\r', '\n', '\n', 0, true};

//# helper console
//#   members: rxChar txChar cogid devst
//#   needs: text_t
//#   setup: Serial.begin(115200);
//#   setup rp2040 renesas_uno teensy mbed_nano: while (!Serial && millis() < 3000) {}
//#   limit rp2040 renesas_uno teensy mbed_nano: what is printed before a computer opens the console would be lost: the program waits for that
//#   limit rp2040 renesas_uno teensy mbed_nano: without a computer it starts after 3 s, or after console_wait_ms of robosmi.toml
//#   ram: 45
static text_t console = {&Serial, 0, '\r', '\n', '\n', 0, true, 0, 0, {0}, 0};

//# variable dport_ptr
//#   needs: text_t console
//#   fidelity: exact: the device of print and its like, 0 when it is closed
//#   ram: 2
static text_t *dport_ptr = &console;

//# adapter set_endChars
//#   for: void set_endChars(text_t *text, char cA, char cB)
//#   kind: oneToOne
//#   needs: text_t
//#   fidelity: exact
//#   stack: 0
inline void set_endChars(text_t *text, char cA, char cB) {
  text->ecA = cA;
  text->ecB = cB;
}

//# adapter set_endCharSequence
//#   for: void set_endCharSequence(text_t *text, char cA, char cB)
//#   kind: oneToOne
//#   needs: text_t
//#   fidelity: exact
//#   stack: 0
inline void set_endCharSequence(text_t *text, char cA, char cB) {
  text->ecsA = cA;
  text->ecsB = cB;
}

//# adapter terminal_setEcho
//#   for: void terminal_setEcho(text_t *text, int state)
//#   kind: oneToOne
//#   needs: text_t
//#   fidelity: exact
//#   stack: 0
inline void terminal_setEcho(text_t *text, int32_t state) {
  text->terminalEcho = state;
}

//# adapter terminal_checkEcho
//#   for: int terminal_checkEcho(text_t *text)
//#   kind: oneToOne
//#   needs: text_t
//#   fidelity: exact
//#   stack: 0
inline int32_t terminal_checkEcho(text_t *text) {
  return text->terminalEcho;
}

//# adapter simpleterm_pointer
//#   for: terminal *simpleterm_pointer(void)
//#   kind: oneToOne
//#   needs: terminal dport_ptr
//#   fidelity: exact
//#   stack: 6
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline terminal *simpleterm_pointer() {
  return dport_ptr;
}

//# adapter simpleterm_close
//#   for: void simpleterm_close(void)
//#   kind: semantic
//#   needs: text_t dport_ptr
//#   fidelity: print and its like send nothing any more
//#   limit: the pins of the console stay with the serial port
//#   stack: 6
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void simpleterm_close() {
  if (dport_ptr && dport_ptr->port) dport_ptr->port->flush();
  dport_ptr = 0;
}

//# helper usb_console
//#   ram: 4
//#   fidelity: USB takes text at once: the program waits as long as a line of the console's rate would send it
static uint32_t console_byte_us = 87;  // of 10 bits

inline void wait_for_usb(Stream &port, int32_t bytes) {
  uint32_t begun = micros(), us = bytes * console_byte_us;
  port.flush();
  delay(us / 1000);
  while (micros() - begun < us) yield();
}

inline void begin_usb(uint32_t baud) {
  Serial.begin(baud);
  if (baud) console_byte_us = 10000000UL / baud;
}

//# adapter simpleterm_open
//#   for: terminal *simpleterm_open(void)
//#   kind: semantic
//#   needs: text_t terminal console dport_ptr hal/begin_console
//#   fidelity: exact: 115200 baud, and a second of waiting when it was closed
//#   stack: 12 6
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline terminal *simpleterm_open() {
  if (dport_ptr) return dport_ptr;
  begin_console(115200);
  console = {&Serial, 0, '\r', '\n', '\n', 0, true};
  dport_ptr = &console;
  delay(1000);
  return dport_ptr;
}

//# adapter simpleterm_reopen
//#   for: terminal *simpleterm_reopen(int rxpin, int txpin, int mode, int baud)
//#   kind: semantic
//#   needs: text_t terminal console dport_ptr ECHO_RX_TO_TX hal/console hal/begin_console
//#   pin: rxpin digital in
//#   pin: txpin digital out
//#   fidelity: exact at the console's pins, or where it is USB; at any others the terminal is not wired
//#   limit: the terminal cannot move to other pins
//#   stack: 8
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline terminal *simpleterm_reopen(int32_t rxpin, int32_t txpin, int32_t mode, int32_t baud) {
  bool wired = is_console(rxpin, txpin);
  Serial.flush();
  if (wired) begin_console(baud);
  console.port = wired ? &Serial : 0;
  console.terminalEcho = console.terminalEcho || mode & ECHO_RX_TO_TX;
  dport_ptr = &console;
  return dport_ptr;
}

//# adapter simpleterm_set
//#   for: void simpleterm_set(text_t *ptr)
//#   kind: oneToMany
//#   needs: text_t dport_ptr simpleterm_close
//#   fidelity: exact
//#   stack: 6
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void simpleterm_set(text_t *ptr) {
  simpleterm_close();
  dport_ptr = ptr;
}

// ---------------------------------------------------------------- single bytes and characters

//# helper sendChar
//#   needs: text_t hal/wait_for_console
//#   fidelity: one that ends a line is sent as the device's line end; it does not wait
inline void sendByte(text_t *device, char c) {
  if (device && device->port) device->port->write((uint8_t)c);
}

inline void sendChar(text_t *device, char c) {
  if (!device) return;
  if (c != device->ecA && c != device->ecB) return sendByte(device, c);
  if (device->ecsA) sendByte(device, device->ecsA);
  if (device->ecsB) sendByte(device, device->ecsB);
}

inline void waitSent(text_t *device, int32_t bytes = 1) {  // the program goes on when the terminal has its text, as there
  if (device && device->port && device->waits) wait_for_console(*device->port, bytes);
}

//# helper sendChar
//#   members: rxChar txChar cogid devst
//#   needs: text_t hal/wait_for_console
//#   fidelity: through the device's own function where it has one; one that ends a line is sent as the device's line end; it does not wait
inline void sendByte(text_t *device, char c) {
  if (!device) return;
  if (device->txChar) device->txChar(device, c);
  else if (device->port) device->port->write((uint8_t)c);
}

inline void sendChar(text_t *device, char c) {
  if (!device) return;
  if (c != device->ecA && c != device->ecB) return sendByte(device, c);
  if (device->ecsA) sendByte(device, device->ecsA);
  if (device->ecsB) sendByte(device, device->ecsB);
}

inline void waitSent(text_t *device, int32_t bytes = 1) {  // the program goes on when the terminal has its text, as there
  if (device && device->port && device->waits) wait_for_console(*device->port, bytes);
}

//# adapter writeByte
//#   for: void writeByte(text_t *p, char c)
//#   kind: oneToOne
//#   needs: text_t sendChar
//#   fidelity: exact: the byte as it is
//#   stack: 2 0
inline void writeByte(text_t *device, char c) {
  sendByte(device, c);
  waitSent(device);
}

//# adapter writeChar
//#   for: void writeChar(text_t *device, char c)
//#   kind: oneToMany
//#   needs: text_t sendChar
//#   fidelity: exact: one that ends a line is sent as the device's line end
//#   stack: 6 2
inline void writeChar(text_t *device, char c) {
  sendChar(device, c);
  waitSent(device);
}

//# adapter putByte
//#   for: void putByte(char c)
//#   kind: oneToOne
//#   needs: dport_ptr writeByte
//#   fidelity: exact
//#   stack: 8
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void putByte(char c) {
  writeByte(dport_ptr, c);
}

//# adapter putChar
//#   for: void putChar(char c)
//#   kind: oneToOne
//#   needs: dport_ptr writeChar
//#   fidelity: exact but for line ends
//#   stack: 12 8
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void putChar(char c) {
  writeChar(dport_ptr, c);
}

//# adapter readByte
//#   for: int readByte(text_t *text)
//#   kind: oneToMany
//#   needs: text_t
//#   fidelity: it waits; 0 to 255. Bytes that came before the call are kept here, 64 of them, and lost there
//#   stack: 4 0
inline int32_t readByte(text_t *device) {
  if (!device || !device->port) return 0;
  while (!device->port->available()) yield();
  return device->port->read();
}

//# adapter readByte
//#   for: int readByte(text_t *text)
//#   kind: oneToMany
//#   members: rxChar txChar cogid devst
//#   needs: text_t
//#   fidelity: it waits; 0 to 255, or what the device's own function gives. Bytes that came to a serial port before the call are
//#   fidelity: kept here, 64 of them, and lost there
inline int32_t readByte(text_t *device) {
  if (!device) return 0;
  if (device->rxChar) return device->rxChar(device);
  if (!device->port) return 0;
  while (!device->port->available()) yield();
  return device->port->read();
}

//# adapter readChar
//#   for: int readChar(text_t *device)
//#   kind: oneToOne
//#   needs: text_t readByte
//#   fidelity: it waits; 0 to 255. Bytes that came before the call are kept here, 64 of them, and lost there
//#   stack: 4 0
inline int32_t readChar(text_t *device) {
  return readByte(device);
}

//# adapter getByte
//#   for: int getByte(void)
//#   kind: oneToOne
//#   needs: dport_ptr readByte
//#   fidelity: it waits; 0 to 255. Bytes that came before the call are kept here, 64 of them, and lost there
//#   stack: 6
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t getByte() {
  return readByte(dport_ptr);
}

//# adapter getChar
//#   for: int getChar(void)
//#   kind: oneToOne
//#   needs: dport_ptr readByte
//#   fidelity: it waits; 0 to 255. Bytes that came before the call are kept here, 64 of them, and lost there
//#   stack: 6
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t getChar() {
  return readByte(dport_ptr);
}

// ---------------------------------------------------------------- writing texts and numbers

//# helper TextOut
//#   needs: text_t sendChar
//#   fidelity: where a text goes, a device or memory; it counts its characters. A character 0 ends what a device gets, as there
struct TextOut {
  text_t *device;
  char *memory;
  int32_t count, room;  // what does not fit is counted, too
  bool ended;

  explicit TextOut(text_t *to) : device(to), memory(0), count(0), room(0), ended(false) {}
  explicit TextOut(char *to, int32_t size = 32767) : device(0), memory(to), count(0), room(size), ended(false) {}
  ~TextOut() { waitSent(device, count); }
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

//# adapter float2string
//#   for: char *float2string(float f, char *s, int width, int precision)
//#   kind: semantic
//#   include: <math.h>
//#   fidelity: exact, digit by digit in the same steps: 6 decimal places at most, and a carry does not add a digit, so that 9.96 with one
//#   fidelity: place is 0.0
//#   stack: 88 73
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

//# helper write_float
//#   needs: TextOut float2string
inline void write_float(TextOut out, float value, int32_t width, int32_t precision) {
  char text[72];
  out.put(float2string(value, text, width > 20 ? 20 : width, precision));
}

//# adapter printNumber
//#   for: int printNumber(text_t *p, unsigned long u, int base, int width, int fill_char)
//#   kind: semantic
//#   needs: text_t TextOut
//#   fidelity: exact: base 2 to 16; the number of characters
//#   stack: 77 60
inline int32_t printNumber(text_t *device, uint32_t u, int32_t base, int32_t width, int32_t fill_char) {
  TextOut out(device);
  out.number(u, (uint8_t)base, width, (char)fill_char);
  return out.count;
}

//# adapter writeStr
//#   for: int writeStr(text_t *device, const char *str)
//#   kind: oneToMany
//#   needs: text_t TextOut
//#   fidelity: exact but for line ends
//#   stack: 12 2
inline int32_t writeStr(text_t *device, const char *str) {
  TextOut out(device);
  out.put(str);
  return out.count;
}

//# adapter putStr
//#   for: int putStr(const char *str)
//#   kind: oneToOne
//#   needs: dport_ptr writeStr
//#   fidelity: exact but for line ends
//#   stack: 33 8
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t putStr(const char *str) {
  return writeStr(dport_ptr, str);
}

//# adapter writeLine
//#   for: int writeLine(text_t *device, const char *str)
//#   kind: oneToMany
//#   needs: text_t TextOut writeChar
//#   fidelity: exact but for line ends
//#   stack: 20 6
inline int32_t writeLine(text_t *device, const char *str) {
  TextOut out(device);
  out.put(str);
  if (device) writeChar(device, device->ecA);
  return out.count;
}

//# adapter putLine
//#   for: int putLine(const char *str)
//#   kind: oneToOne
//#   needs: dport_ptr writeLine
//#   fidelity: exact but for line ends
//#   stack: 26 12
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t putLine(const char *str) {
  return writeLine(dport_ptr, str);
}

//# adapter putln
//#   for: int putln(const char *str)
//#   kind: oneToOne
//#   needs: putLine
//#   fidelity: exact but for line ends
//#   stack: 26 12
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t putln(const char *str) {
  return putLine(str);
}

//# adapter writeStrLen
//#   for: int writeStrLen(text_t *device, char *str, int width)
//#   kind: oneToMany
//#   needs: text_t TextOut
//#   fidelity: exact but for line ends: letters and digits count for the width, and no more than it are sent
//#   stack: 43 27
inline int32_t writeStrLen(text_t *device, const char *str, int32_t width) {
  TextOut out(device);
  int32_t letters = 0;
  while (isalnum((uint8_t)str[letters])) letters++;
  out.fill(width - letters, ' ');
  for (int32_t left = width; *str && left > 0; left--) out.put(*str++);
  return letters > width ? letters : width;
}

//# adapter putStrLen
//#   for: int putStrLen(char *str, int width)
//#   kind: oneToOne
//#   needs: dport_ptr writeStrLen
//#   fidelity: exact but for line ends: letters and digits count for the width, and no more than it are sent
//#   stack: 49 33
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t putStrLen(const char *str, int32_t width) {
  return writeStrLen(dport_ptr, str, width);
}

//# adapter writeDec
//#   for: void writeDec(text_t *device, int value)
//#   kind: oneToMany
//#   needs: text_t writeChar printNumber
//#   fidelity: exact
//#   stack: 74 62
inline void writeDec(text_t *device, int32_t value) {
  if (value < 0) writeChar(device, '-');
  printNumber(device, labs(value), 10, 0, ' ');
}

//# adapter putDec
//#   for: void putDec(int value)
//#   kind: oneToOne
//#   needs: dport_ptr writeDec
//#   fidelity: exact
//#   stack: 80 68
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void putDec(int32_t value) {
  writeDec(dport_ptr, value);
}

//# adapter writeDecLen
//#   for: void writeDecLen(text_t *device, int value, int width)
//#   kind: oneToMany
//#   needs: text_t writeChar printNumber
//#   fidelity: exact: a minus sign comes before the padding, and the width does not count it
//#   stack: 76 62
inline void writeDecLen(text_t *device, int32_t value, int32_t width) {
  if (value < 0) writeChar(device, '-');
  printNumber(device, labs(value), 10, width, ' ');
}

//# adapter putDecLen
//#   for: void putDecLen(int value, int width)
//#   kind: oneToMany
//#   needs: dport_ptr writeChar printNumber
//#   fidelity: exact: a minus sign comes before the padding, and the width does not count it
//#   stack: 84 68
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void putDecLen(int32_t value, int32_t width) {
  if (value < 0) writeChar(dport_ptr, '-');
  printNumber(dport_ptr, labs(value), 10, width, '0');
}

//# adapter writeBin
//#   for: void writeBin(text_t *device, int value)
//#   kind: oneToMany
//#   needs: text_t printNumber
//#   fidelity: exact
//#   stack: 60
inline void writeBin(text_t *device, int32_t value) {
  printNumber(device, value, 2, 0, ' ');
}

//# adapter putBin
//#   for: void putBin(int value)
//#   kind: oneToOne
//#   needs: dport_ptr writeBin
//#   fidelity: exact
//#   stack: 66
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void putBin(int32_t value) {
  writeBin(dport_ptr, value);
}

//# adapter writeBinLen
//#   for: void writeBinLen(text_t *device, int value, int digits)
//#   kind: oneToMany
//#   needs: text_t printNumber
//#   fidelity: exact
//#   stack: 70 60
inline void writeBinLen(text_t *device, int32_t value, int32_t digits) {
  printNumber(device, value, 2, digits, ' ');
}

//# adapter putBinLen
//#   for: void putBinLen(int value, int digits)
//#   kind: oneToMany
//#   needs: dport_ptr printNumber
//#   fidelity: exact
//#   stack: 66
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void putBinLen(int32_t value, int32_t digits) {
  printNumber(dport_ptr, value, 2, digits, '0');
}

//# adapter writeHex
//#   for: void writeHex(text_t *device, int value)
//#   kind: oneToMany
//#   needs: text_t printNumber
//#   fidelity: exact
//#   stack: 60
inline void writeHex(text_t *device, int32_t value) {
  printNumber(device, value, 16, 0, ' ');
}

//# adapter putHex
//#   for: void putHex(int value)
//#   kind: oneToOne
//#   needs: dport_ptr writeHex
//#   fidelity: exact
//#   stack: 66
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void putHex(int32_t value) {
  writeHex(dport_ptr, value);
}

//# adapter writeHexLen
//#   for: void writeHexLen(text_t *device, int value, int digits)
//#   kind: oneToMany
//#   needs: text_t printNumber
//#   fidelity: exact
//#   stack: 70 60
inline void writeHexLen(text_t *device, int32_t value, int32_t digits) {
  printNumber(device, value, 16, digits, ' ');
}

//# adapter putHexLen
//#   for: void putHexLen(int value, int digits)
//#   kind: oneToMany
//#   needs: dport_ptr printNumber
//#   fidelity: exact
//#   stack: 66
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void putHexLen(int32_t value, int32_t digits) {
  printNumber(dport_ptr, value, 16, digits, '0');
}

//# adapter writeFloat
//#   for: void writeFloat(text_t *device, float value)
//#   kind: oneToMany
//#   needs: text_t TextOut write_float
//#   fidelity: exact: 6 decimal places
//#   stack: 156 139
inline void writeFloat(text_t *device, float value) {
  write_float(TextOut(device), value, 1, 10);
}

//# adapter putFloat
//#   for: void putFloat(float value)
//#   kind: oneToMany
//#   needs: dport_ptr TextOut write_float
//#   fidelity: exact: 6 decimal places
//#   stack: 153 137
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void putFloat(float value) {
  write_float(TextOut(dport_ptr), value, 4, 10);
}

//# adapter writeFloatPrecision
//#   for: void writeFloatPrecision(text_t *device, float value, int width, int precision)
//#   kind: oneToMany
//#   needs: text_t TextOut write_float
//#   fidelity: exact up to a width of 20
//#   stack: 161 144
inline void writeFloatPrecision(text_t *device, float value, int32_t width, int32_t precision) {
  write_float(TextOut(device), value, width, precision);
}

//# adapter putFloatPrecision
//#   for: void putFloatPrecision(float value, int width, int precision)
//#   kind: oneToOne
//#   needs: dport_ptr writeFloatPrecision
//#   fidelity: exact up to a width of 20
//#   stack: 161 143
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void putFloatPrecision(float value, int32_t width, int32_t precision) {
  writeFloatPrecision(dport_ptr, value, width, precision);
}

//# adapter putStrWithNpcVals
//#   for: int putStrWithNpcVals(const char *s)
//#   kind: oneToMany
//#   needs: dport_ptr TextOut
//#   fidelity: exact but for line ends
//#   stack: 84 66
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t putStrWithNpcVals(const char *s) {
  TextOut out(dport_ptr);
  for (const char *at = s;; at++) {
    if (*at >= ' ' && *at <= '~') {
      out.put(*at);
      continue;
    }
    out.put('[');
    out.number((uint8_t)*at, 10, 0, ' ');
    out.put(']');
    if (*at == '\n' || *at == '\r') out.put(*at);
    if (!*at) return at - s;
  }
}

// ---------------------------------------------------------------- formats

//# helper TextArgument
//#   fidelity: an argument of print as it is there: 32 bits of integer, a float or a text
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
  TextArgument(Pointed *value) : kind('d'), integer((int32_t)(uintptr_t)value) {}
  template <class Integer>
  TextArgument(Integer value) : kind('d'), integer((int32_t)value) {}

  int32_t number() const { return kind == 'f' ? (int32_t)real : integer; }
};

//# helper format_text
//#   needs: TextOut TextArgument float2string
//#   fidelity: %d %u %x %b %c %s %f %%, with a 0, a width and a precision. As there, a text has no width, a minus sign comes before the
//#   fidelity: padding, and what is not known prints nothing and takes no argument
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

//# adapter print
//#   for: int print(const char *format, ...)
//#   kind: semantic
//#   needs: dport_ptr TextOut TextArgument format_text
//#   fidelity: exact but for line ends, in 32 bits; texts of more than 255 characters, which overflow a buffer there, are printed
//#   stack: 275 253
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
template <class... Arguments>
inline int32_t print(const char *format, Arguments... given) {
  const TextArgument arguments[] = {TextArgument(), given...};
  return format_text<true>(TextOut(dport_ptr), format, arguments + 1, sizeof...(given));
}

//# adapter printi
//#   for: int printi(const char *format, ...)
//#   kind: semantic
//#   needs: dport_ptr TextOut TextArgument format_text
//#   fidelity: exact but for line ends, in 32 bits; %f prints nothing, as there; texts of more than 255 characters, which overflow a buffer there, are printed
//#   stack: 275 253
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
template <class... Arguments>
inline int32_t printi(const char *format, Arguments... given) {
  const TextArgument arguments[] = {TextArgument(), given...};
  return format_text<false>(TextOut(dport_ptr), format, arguments + 1, sizeof...(given));
}

//# adapter dprint
//#   for: int dprint(text_t *device, const char *format, ...)
//#   kind: semantic
//#   needs: text_t TextOut TextArgument format_text
//#   fidelity: exact but for line ends, in 32 bits; texts of more than 255 characters, which overflow a buffer there, are printed
//#   stack: 269 247
template <class... Arguments>
inline int32_t dprint(text_t *device, const char *format, Arguments... given) {
  const TextArgument arguments[] = {TextArgument(), given...};
  return format_text<true>(TextOut(device), format, arguments + 1, sizeof...(given));
}

//# adapter dprinti
//#   for: int dprinti(text_t *device, const char *format, ...)
//#   kind: semantic
//#   needs: text_t TextOut TextArgument format_text
//#   fidelity: exact but for line ends, in 32 bits; %f prints nothing, as there; texts of more than 255 characters, which overflow a buffer there, are printed
//#   stack: 269 247
template <class... Arguments>
inline int32_t dprinti(text_t *device, const char *format, Arguments... given) {
  const TextArgument arguments[] = {TextArgument(), given...};
  return format_text<false>(TextOut(device), format, arguments + 1, sizeof...(given));
}

//# adapter sprint
//#   for: int sprint(char *buffer, const char *format, ...)
//#   kind: semantic
//#   needs: TextOut TextArgument format_text
//#   fidelity: exact, in 32 bits
//#   stack: 269 247
template <class... Arguments>
inline int32_t sprint(char *buffer, const char *format, Arguments... given) {
  const TextArgument arguments[] = {TextArgument(), given...};
  return format_text<true>(TextOut(buffer), format, arguments + 1, sizeof...(given));
}

//# adapter sprinti
//#   for: int sprinti(char *buffer, const char *format, ...)
//#   kind: semantic
//#   needs: TextOut TextArgument format_text
//#   fidelity: exact, in 32 bits; %f prints nothing, as there
//#   stack: 269 247
template <class... Arguments>
inline int32_t sprinti(char *buffer, const char *format, Arguments... given) {
  const TextArgument arguments[] = {TextArgument(), given...};
  return format_text<false>(TextOut(buffer), format, arguments + 1, sizeof...(given));
}

// ---------------------------------------------------------------- reading

//# adapter readStr
//#   for: char *readStr(text_t *device, char *buffer, int max)
//#   kind: oneToMany
//#   needs: text_t readByte writeByte
//#   fidelity: exact: up to a line end, or `max` characters and a 0 behind them; echo and backspace only when echo is on
//#   limit: a terminal that ends lines with both CR and LF sends an empty line more, as there
//#   stack: 20 2
inline char *readStr(text_t *device, char *buffer, int32_t max) {
  char *end = buffer;
  for (int32_t left = max; device && left > 0;) {
    char c = (char)readByte(device);
    if (device->terminalEcho) {
      if (c == 8 || c == 127) {
        if (end == buffer) continue;
        for (const char *back = "\b \b"; *back; back++) writeByte(device, *back);
        end--;
        left++;
        continue;
      }
      if (c != device->ecA && c != device->ecB) {
        writeByte(device, c);
      } else {
        if (device->ecsA) writeByte(device, device->ecsA);
        if (device->ecsB) writeByte(device, device->ecsB);
      }
    }
    if (c == '\r' || c == '\n') break;
    *end++ = c;
    left--;
  }
  *end = 0;
  return buffer;
}

//# adapter getStr
//#   for: char *getStr(char *buffer, int max)
//#   kind: oneToOne
//#   needs: dport_ptr readStr
//#   fidelity: exact: up to a line end, or `max` characters and a 0 behind them
//#   stack: 26 8
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline char *getStr(char *buffer, int32_t max) {
  return readStr(dport_ptr, buffer, max);
}

//# helper scan_integer
//#   fidelity: leaves out what cannot begin a number; 0 without one. As there, a digit that ends a width is read again
inline const char *scan_integer(const char *text, int32_t *value, uint8_t base, uint8_t width, bool sign) {
  const char *first = base == 2 ? "01" : base == 10 ? "+-0123456789" : "0123456789abcdefABCDEF";
  while (*text && !strchr(first, *text)) text++;
  bool negative = sign && *text == '-', any = false;
  if (sign && (*text == '-' || *text == '+')) text++;
  uint32_t found = 0;
  for (; width; width--, text++) {
    char c = *text;
    if (base == 2 && (c == '.' || c == '_')) continue;
    if (!isdigit((uint8_t)c) && !(base == 16 && isxdigit((uint8_t)c))) break;
    found = found * base + (isdigit((uint8_t)c) ? c - '0' : (c | 32) - 'a' + 10);
    any = true;
  }
  if (!any) return 0;
  *value = negative ? -found : found;
  return width ? text : text - 1;
}

//# adapter string2float
//#   for: float string2float(char *s, char **end)
//#   kind: semantic
//#   fidelity: exact, in the same steps; it leaves out what cannot begin a number, and there is no exponent
//#   stack: 23 2
inline float string2float(const char *s, char **end) {
  while (*s && !strchr("+-.0123456789", *s)) s++;
  bool negative = *s == '-';
  if (negative) s++;
  if (*s == '+') s++;
  float value = 0, place = 0.1;
  for (; isdigit((uint8_t)*s); s++) value = 10 * value + (*s - '0');
  if (*s == '.')
    for (s++; isdigit((uint8_t)*s); s++, place /= 10) value += place * (*s - '0');
  *end = (char *)s;
  return negative ? -value : value;
}

//# adapter readDec
//#   for: int readDec(text_t *device)
//#   kind: oneToMany
//#   needs: text_t readStr scan_integer
//#   fidelity: exact; 0 for a line without a number
//#   stack: 62 44
inline int32_t readDec(text_t *device) {
  char line[40];
  int32_t value = 0;
  scan_integer(readStr(device, line, 39), &value, 10, 11, true);
  return value;
}

//# adapter getDec
//#   for: int getDec(void)
//#   kind: oneToOne
//#   needs: dport_ptr readDec
//#   fidelity: exact; 0 for a line without a number
//#   stack: 66 50
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t getDec() {
  return readDec(dport_ptr);
}

//# adapter readBin
//#   for: int readBin(text_t *device)
//#   kind: oneToMany
//#   needs: text_t readStr scan_integer
//#   fidelity: exact; 0 for a line without a number
//#   stack: 58 44
inline int32_t readBin(text_t *device) {
  char line[40];
  int32_t value = 0;
  scan_integer(readStr(device, line, 39), &value, 2, 32, false);
  return value;
}

//# adapter getBin
//#   for: int getBin(void)
//#   kind: oneToOne
//#   needs: dport_ptr readBin
//#   fidelity: exact; 0 for a line without a number
//#   stack: 64 50
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t getBin() {
  return readBin(dport_ptr);
}

//# adapter readHex
//#   for: int readHex(text_t *device)
//#   kind: oneToMany
//#   needs: text_t readStr scan_integer
//#   fidelity: exact; 0 for a line without a number
//#   stack: 33 17
inline int32_t readHex(text_t *device) {
  char line[13];
  int32_t value = 0;
  scan_integer(readStr(device, line, 12), &value, 16, 9, false);
  return value;
}

//# adapter getHex
//#   for: int getHex(void)
//#   kind: oneToOne
//#   needs: dport_ptr readHex
//#   fidelity: exact; 0 for a line without a number
//#   stack: 39 23
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t getHex() {
  return readHex(dport_ptr);
}

//# adapter readFloat
//#   for: float readFloat(text_t *device)
//#   kind: oneToMany
//#   needs: text_t readStr string2float
//#   fidelity: exact; 0 for a line without a number
//#   stack: 47 25
inline float readFloat(text_t *device) {
  char line[21], *end;
  return string2float(readStr(device, line, 20), &end);
}

//# adapter getFloat
//#   for: float getFloat(void)
//#   kind: oneToOne
//#   needs: dport_ptr readFloat
//#   fidelity: exact; 0 for a line without a number
//#   stack: 51 31
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline float getFloat() {
  return readFloat(dport_ptr);
}

//# helper ScanTarget
//#   fidelity: a variable that scan fills, of the size that it has here
struct ScanTarget {
  void *at;
  uint8_t size;
  bool real;

  ScanTarget() : at(0), size(0), real(false) {}
  template <class Variable>
  ScanTarget(Variable *variable) : at((void *)variable), size(sizeof(Variable)), real(false) {}
  ScanTarget(float *variable) : at(variable), size(sizeof(float)), real(true) {}
  ScanTarget(double *variable) : at(variable), size(sizeof(double)), real(true) {}

  void take(int32_t value) const { memcpy(at, &value, size < 4 ? size : 4); }
  void take(float value) const {
    double wide = value;
    if (sizeof wide > sizeof value && real && size == sizeof wide) memcpy(at, &wide, sizeof wide);
    else if (real || size == sizeof value) memcpy(at, &value, sizeof value);
  }
};

//# helper scan_text
//#   needs: ScanTarget scan_integer string2float
//#   fidelity: %d %u %x %b %f %s %c %%, with a width; the number of variables filled. It stops at the end of a text, where the library reads on
template <bool floats>
inline int32_t scan_text(const char *text, const char *format, const ScanTarget *targets, uint8_t count) {
  const ScanTarget *last = targets + count;
  int32_t filled = 0;
  while (text && *text && *format) {
    char c = *format++;
    if (isspace((uint8_t)c)) {
      while (isspace((uint8_t)*text)) text++;
      continue;
    }
    if (c != '%') {
      if (*text++ != c) break;
      continue;
    }
    uint8_t width = 255;
    if (isdigit((uint8_t)*format))
      for (width = 0; isdigit((uint8_t)*format); format++) width = 10 * width + (*format - '0');
    c = *format++;
    if (c == '%') {
      if (*text++ != '%') break;
      continue;
    }
    if (c != 'c')
      while (isspace((uint8_t)*text)) text++;
    if (!*text || !c || !strchr(floats ? "bcdefgsux" : "bcdsux", c) || targets == last) break;
    const ScanTarget &target = *targets++;
    if (c == 'c' || c == 's') {
      char *to = (char *)target.at;
      if (c == 'c' && width == 255) width = 1;
      for (; width && *text && (c == 'c' || !isspace((uint8_t)*text)); width--) *to++ = *text++;
      if (c == 's') *to = 0;
    } else if (floats && strchr("efg", c)) {
      char *end;
      target.take(string2float(text, &end));  // 0 for a text without a number, and "5." is 5, as there
      text = end;
    } else {
      int32_t value;
      text = scan_integer(text, &value, c == 'b' ? 2 : c == 'x' ? 16 : 10, width, c == 'd' || c == 'b');
      if (!text) break;
      target.take(value);
    }
    filled++;
  }
  return filled;
}

//# adapter scan
//#   for: int scan(const char *fmt, ...)
//#   kind: semantic
//#   needs: dport_ptr readStr ScanTarget scan_text
//#   fidelity: exact: the number of variables filled; integers of any width are filled
//#   limit: a line of more than 80 characters is taken in parts; there 256
//#   stack: 141 120
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
template <class... Targets>
inline int32_t scan(const char *fmt, Targets... targets) {
  char line[81];
  const ScanTarget variables[] = {ScanTarget(), targets...};
  return scan_text<true>(readStr(dport_ptr, line, 80), fmt, variables + 1, sizeof...(targets));
}

//# adapter scani
//#   for: int scani(const char *fmt, ...)
//#   kind: semantic
//#   needs: dport_ptr readStr ScanTarget scan_text
//#   fidelity: exact: the number of variables filled; integers of any width are filled; no %f, as there
//#   limit: a line of more than 80 characters is taken in parts; there 256
//#   stack: 140 120
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
template <class... Targets>
inline int32_t scani(const char *fmt, Targets... targets) {
  char line[81];
  const ScanTarget variables[] = {ScanTarget(), targets...};
  return scan_text<false>(readStr(dport_ptr, line, 80), fmt, variables + 1, sizeof...(targets));
}

//# adapter dscan
//#   for: int dscan(text_t *device, const char *fmt, ...)
//#   kind: semantic
//#   needs: text_t readStr ScanTarget scan_text
//#   fidelity: exact: the number of variables filled; integers of any width are filled
//#   limit: a line of more than 80 characters is taken in parts; there 256
//#   stack: 143 120
template <class... Targets>
inline int32_t dscan(text_t *device, const char *fmt, Targets... targets) {
  char line[81];
  const ScanTarget variables[] = {ScanTarget(), targets...};
  return scan_text<true>(readStr(device, line, 80), fmt, variables + 1, sizeof...(targets));
}

//# adapter dscani
//#   for: int dscani(text_t *device, const char *fmt, ...)
//#   kind: semantic
//#   needs: text_t readStr ScanTarget scan_text
//#   fidelity: exact: the number of variables filled; integers of any width are filled; no %f, as there
//#   limit: a line of more than 80 characters is taken in parts; there 256
//#   stack: 140 120
template <class... Targets>
inline int32_t dscani(text_t *device, const char *fmt, Targets... targets) {
  char line[81];
  const ScanTarget variables[] = {ScanTarget(), targets...};
  return scan_text<false>(readStr(device, line, 80), fmt, variables + 1, sizeof...(targets));
}

//# adapter sscan
//#   for: int sscan(const char *buffer, const char *fmt, ...)
//#   kind: semantic
//#   needs: ScanTarget scan_text
//#   fidelity: exact: the number of variables filled; integers of any width are filled
//#   stack: 59 38
template <class... Targets>
inline int32_t sscan(const char *buffer, const char *fmt, Targets... targets) {
  const ScanTarget variables[] = {ScanTarget(), targets...};
  return scan_text<true>(buffer, fmt, variables + 1, sizeof...(targets));
}

//# adapter sscani
//#   for: int sscani(const char *buffer, const char *fmt, ...)
//#   kind: semantic
//#   needs: ScanTarget scan_text
//#   fidelity: exact: the number of variables filled; integers of any width are filled; no %f, as there
//#   stack: 59 37
template <class... Targets>
inline int32_t sscani(const char *buffer, const char *fmt, Targets... targets) {
  const ScanTarget variables[] = {ScanTarget(), targets...};
  return scan_text<false>(buffer, fmt, variables + 1, sizeof...(targets));
}

//# adapter sscanAfterStr
//#   for: int sscanAfterStr(char *buffer, char *str, char *fmt, ...)
//#   kind: semantic
//#   needs: ScanTarget scan_text
//#   fidelity: exact: the number of variables filled; integers of any width are filled; 0 when the text is not there
//#   stack: 60 0
template <class... Targets>
inline int32_t sscanAfterStr(const char *buffer, const char *str, const char *fmt, Targets... targets) {
  const char *found = strstr(buffer, str);
  if (!found) return 0;
  const ScanTarget variables[] = {ScanTarget(), targets...};
  return scan_text<true>(found + strlen(str), fmt, variables + 1, sizeof...(targets));
}

//# adapter getStopCOGID
//#   for: int getStopCOGID(int id)
//#   kind: oneToOne
//#   fidelity: exact: one less
//#   stack: 0
inline int32_t getStopCOGID(int32_t id) {
  return id - 1;
}

//# adapter setStopCOGID
//#   for: int setStopCOGID(int id)
//#   kind: oneToOne
//#   fidelity: exact: one more
//#   stack: 0
inline int32_t setStopCOGID(int32_t id) {
  return id + 1;
}

// ---------------------------------------------------------------- values in a list

//# helper ListArguments
//#   needs: TextArgument
//#   include: <stdarg.h>
//#   fidelity: up to 12 values of a list, as their conversions say: a text, a float, or 32 bits of integer, of which all others are made
struct ListArguments {
  TextArgument values[12];
  uint8_t count;

  ListArguments(const char *format, va_list list) : count(0) {
    for (; *format && count < 12; format++) {
      if (*format != '%') continue;
      for (format++; *format && (!isalpha((uint8_t)*format) || strchr("hlLjtz", *format)) && *format != '%'; format++)
        if (*format == '*' && count < 12) values[count++] = TextArgument(va_arg(list, int32_t));
      if (!*format) break;
      if (*format == '%' || count == 12) continue;
      if (*format == 's') values[count++] = TextArgument(va_arg(list, const char *));
      else if (*format == 'p') values[count++] = TextArgument((int32_t)va_arg(list, uintptr_t));
      else if (strchr("fFeEgGaA", *format)) values[count++] = TextArgument(va_arg(list, double));
      else values[count++] = TextArgument(va_arg(list, int32_t));
    }
  }
};

//# adapter _dosprnt
//#   for: int _dosprnt(const char *fmt, va_list args, char *obuf)
//#   for: int _dosprnt(const char *fmt, __va_list args, char *obuf)
//#   kind: semantic
//#   needs: ListArguments TextOut format_text
//#   include: <stdarg.h>
//#   fidelity: exact: as sprint
//#   limit: at most 12 values
//#   stack: 315 293
inline int32_t _dosprnt(const char *fmt, va_list args, char *obuf) {
  ListArguments given(fmt, args);
  return format_text<true>(TextOut(obuf), fmt, given.values, given.count);
}

//# adapter _intsprnt
//#   for: int _intsprnt(const char *fmt, va_list args, char *obuf)
//#   for: int _intsprnt(const char *fmt, __va_list args, char *obuf)
//#   kind: semantic
//#   needs: ListArguments TextOut format_text
//#   include: <stdarg.h>
//#   fidelity: exact: as sprinti
//#   limit: at most 12 values
//#   stack: 315 293
inline int32_t _intsprnt(const char *fmt, va_list args, char *obuf) {
  ListArguments given(fmt, args);
  return format_text<false>(TextOut(obuf), fmt, given.values, given.count);
}

//# adapter _scanf_getl
//#   for: const char *_scanf_getl(const char *str, int *dst, int base, unsigned width, int isSigned)
//#   kind: semantic
//#   include: <ctype.h>
//#   fidelity: exact: the first number in a text, up to so many characters of it, and what follows it; 0 when it has no digit.
//#   fidelity: Where the characters are used up it is the last of them, as there
//#   limit: a text without a number ends the search, which goes on behind the text there
//#   stack: 40 20
template <class Int>
inline const char *_scanf_getl(const char *str, Int *dst, int32_t base, uint32_t width, int32_t isSigned) {
  const char *starts = base == 2 ? "01" : base == 10 ? "-+0123456789" : "0123456789abcdefABCDEF";
  while (*str && (base == 2 || base == 10 || base == 16 ? !strchr(starts, *str) : *str == ' ' || *str == '\t')) str++;
  bool negative = isSigned && *str == '-', found = false;
  if (isSigned && (*str == '+' || *str == '-')) str++;
  uint32_t number = 0;
  for (; width; width--, str++) {
    char c = *str;
    if (base == 2 && (c == '.' || c == '_')) continue;
    if (!isdigit((uint8_t)c) && !(base == 16 && isxdigit((uint8_t)c))) {
      if (!found) return 0;
      break;
    }
    found = true;
    number = base * number + (isdigit((uint8_t)c) ? c - '0' : (c | 32) - 'a' + 10);
  }
  *dst = (Int)(negative ? -number : number);
  return width ? str : str - 1;
}

//# adapter _scanf_getf
//#   for: const char *_scanf_getf(const char *str, float *dst)
//#   kind: oneToOne
//#   needs: string2float
//#   fidelity: exact: as string2float
//#   stack: 27 8
inline const char *_scanf_getf(const char *str, float *dst) {
  char *end;
  *dst = string2float((char *)str, &end);
  return end;
}
