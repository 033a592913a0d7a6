//# header simpletext.h
// Texts on the terminal, in C. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/TextDevices/libsimpletext.
// A variadic function would read the 16 bits of an int where the program wrote 32, so print and its like are macros that take each
// argument with its own type.

//# constant HOME
//#   fidelity: exact
//#   limit: only a Parallax terminal obeys it
#define HOME 1L

//# constant CRSRXY
//#   fidelity: exact
//#   limit: only a Parallax terminal obeys it
#define CRSRXY 2L

//# constant CRSRLF
//#   fidelity: exact
//#   limit: only a Parallax terminal obeys it
#define CRSRLF 3L

//# constant CRSRRT
//#   fidelity: exact
//#   limit: only a Parallax terminal obeys it
#define CRSRRT 4L

//# constant CRSRUP
//#   fidelity: exact
//#   limit: only a Parallax terminal obeys it
#define CRSRUP 5L

//# constant CRSRDN
//#   fidelity: exact
//#   limit: only a Parallax terminal obeys it
#define CRSRDN 6L

//# constant BEEP
//#   fidelity: exact
//#   limit: only a Parallax terminal obeys it
#define BEEP 7L

//# constant BKSP
//#   fidelity: exact
//#   limit: only a Parallax terminal obeys it
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
//#   limit: only a Parallax terminal obeys it
#define CLREOL 11L

//# constant CLRDN
//#   fidelity: exact
//#   limit: only a Parallax terminal obeys it
#define CLRDN 12L

//# constant CR
//#   fidelity: exact
#define CR 13L

//# constant CRSRX
//#   fidelity: exact
//#   limit: only a Parallax terminal obeys it
#define CRSRX 14L

//# constant CRSRY
//#   fidelity: exact
//#   limit: only a Parallax terminal obeys it
#define CRSRY 15L

//# constant CLS
//#   fidelity: exact
//#   limit: only a Parallax terminal obeys it
#define CLS 16L

//# constant ECHO_RX_TO_TX
//#   fidelity: exact
#define ECHO_RX_TO_TX 32L

//# type text_t
//#   fidelity: for use with the functions; there are no rxChar, txChar, cogid and devst
typedef struct {
  bool open;  // at the console
  char terminalEcho, ecA, ecB, ecsA, ecsB;
  struct SerialLine *line;  // at other pins
} text_t;

//# helper line_write
//#   needs: text_t
//#   fidelity: how serial lines at other pins than the console's send, where a program has them
//#   ram: 2
static void (*line_write)(struct SerialLine *line, uint8_t byte);

//# helper line_read
//#   needs: text_t
//#   fidelity: how they receive: -1 without a byte
//#   ram: 2
static int16_t (*line_read)(struct SerialLine *line);

//# type terminal
//#   needs: text_t
//#   fidelity: exact
typedef text_t terminal;

//# helper usart_ring
//#   fidelity: what came on the serial line of the console and is not read yet; more than fits is lost
//#   ram: 66
enum { usart_room = 64 };
static volatile uint8_t usart_bytes[usart_room], usart_first, usart_next;

static inline void usart_take(uint8_t byte) {
  uint8_t next = (usart_next + 1) % usart_room;
  if (next == usart_first) return;
  usart_bytes[usart_next] = byte;
  usart_next = next;
}

static inline int16_t usart_get(void) {  // -1 without a byte
  if (usart_first == usart_next) return -1;
  uint8_t byte = usart_bytes[usart_first];
  usart_first = (usart_first + 1) % usart_room;
  return byte;
}

//# helper usart_receiver
//#   needs: usart_ring
//#   include: <avr/interrupt.h>
//#   vector: USART_RX_vect
//#   fidelity: what comes on the serial line is taken in the background
ISR(USART_RX_vect) {
  usart_take(UDR0);
}

//# helper usart_receiver
//#   needs: usart_ring
//#   include: <avr/interrupt.h>
//#   vector: USART0_RX_vect
//#   mcu: atmega2560
//#   fidelity: what comes on the serial line is taken in the background
ISR(USART0_RX_vect) {
  usart_take(UDR0);
}

//# helper usart_receiver
//#   needs: usart_ring
//#   include: <avr/interrupt.h>
//#   vector: USART1_RX_vect
//#   mcu: atmega32u4
//#   fidelity: what comes on the serial line is taken in the background
ISR(USART1_RX_vect) {
  usart_take(UDR1);
}

//# helper usart_registers
//#   needs: usart_receiver
//#   include: <avr/interrupt.h>
//#   fidelity: the serial line of the console
//#   ram: 1
static bool usart_used;  // something was sent

static inline bool usart_is_free(void) { return UCSR0A & _BV(UDRE0); }

static inline void usart_put(uint8_t byte) {
  while (!usart_is_free()) {}
  UCSR0A = _BV(U2X0) | _BV(TXC0);
  UDR0 = byte;
  usart_used = true;
}

static inline void usart_flush(void) {
  while (usart_used && !(UCSR0A & _BV(TXC0))) {}
}

static inline void usart_close(void) { UCSR0B = 0; }

static inline void usart_open(uint32_t baud) {
  UCSR0A = _BV(U2X0);
  UBRR0 = (F_CPU / 4 / baud - 1) / 2;
  UCSR0B = _BV(RXCIE0) | _BV(RXEN0) | _BV(TXEN0);
  sei();
}

//# helper usart_registers
//#   needs: usart_receiver
//#   include: <avr/interrupt.h>
//#   mcu: atmega32u4
//#   fidelity: the serial line of the console
//#   ram: 1
static bool usart_used;  // something was sent

static inline bool usart_is_free(void) { return UCSR1A & _BV(UDRE1); }

static inline void usart_put(uint8_t byte) {
  while (!usart_is_free()) {}
  UCSR1A = _BV(U2X1) | _BV(TXC1);
  UDR1 = byte;
  usart_used = true;
}

static inline void usart_flush(void) {
  while (usart_used && !(UCSR1A & _BV(TXC1))) {}
}

static inline void usart_close(void) { UCSR1B = 0; }

static inline void usart_open(uint32_t baud) {
  UCSR1A = _BV(U2X1);
  UBRR1 = (F_CPU / 4 / baud - 1) / 2;
  UCSR1B = _BV(RXCIE1) | _BV(RXEN1) | _BV(TXEN1);
  sei();
}

//# helper console
//#   needs: text_t usart_registers
//#   ram: 8
static text_t console;

__attribute__((constructor, used)) static void console_open(void) {
  usart_open(115200);
  console.open = true;
  console.ecA = '\r';
  console.ecB = console.ecsA = '\n';
}

//# variable dport_ptr
//#   needs: text_t console
//#   fidelity: exact: the device of print and its like, 0 when it is closed
//#   ram: 2
static text_t *dport_ptr __attribute__((unused)) = &console;

//# adapter set_endChars
//#   for: void set_endChars(text_t *text, char cA, char cB)
//#   kind: oneToOne
//#   needs: text_t
//#   fidelity: exact
static inline void set_endChars(text_t *text, char cA, char cB) {
  text->ecA = cA;
  text->ecB = cB;
}

//# adapter set_endCharSequence
//#   for: void set_endCharSequence(text_t *text, char cA, char cB)
//#   kind: oneToOne
//#   needs: text_t
//#   fidelity: exact
static inline void set_endCharSequence(text_t *text, char cA, char cB) {
  text->ecsA = cA;
  text->ecsB = cB;
}

//# adapter terminal_setEcho
//#   for: void terminal_setEcho(text_t *text, int state)
//#   kind: oneToOne
//#   needs: text_t
//#   fidelity: exact
static inline void terminal_setEcho(text_t *text, int32_t state) {
  text->terminalEcho = state;
}

//# adapter terminal_checkEcho
//#   for: int terminal_checkEcho(text_t *text)
//#   kind: oneToOne
//#   needs: text_t
//#   fidelity: exact
static inline int32_t terminal_checkEcho(text_t *text) {
  return text->terminalEcho;
}

//# adapter simpleterm_pointer
//#   for: terminal *simpleterm_pointer(void)
//#   kind: oneToOne
//#   needs: terminal dport_ptr
//#   fidelity: exact
static inline terminal *simpleterm_pointer(void) {
  return dport_ptr;
}

//# adapter simpleterm_close
//#   for: void simpleterm_close(void)
//#   kind: semantic
//#   needs: dport_ptr usart_registers
//#   fidelity: print and its like send nothing any more
//#   limit: the pins of the console stay with the serial port
static inline void simpleterm_close(void) {
  if (dport_ptr && dport_ptr->open) usart_flush();
  dport_ptr = 0;
}

//# adapter simpleterm_open
//#   for: terminal *simpleterm_open(void)
//#   kind: semantic
//#   needs: terminal console dport_ptr propeller.h/clock_wait
//#   fidelity: exact: 115200 baud, and a second of waiting when it was closed
static inline terminal *simpleterm_open(void) {
  if (dport_ptr) return dport_ptr;
  console_open();
  console.terminalEcho = console.ecsB = 0;
  dport_ptr = &console;
  clock_wait(1000);
  return dport_ptr;
}

//# adapter simpleterm_reopen
//#   for: terminal *simpleterm_reopen(int rxpin, int txpin, int mode, int baud)
//#   kind: semantic
//#   needs: terminal console dport_ptr usart_registers ECHO_RX_TO_TX
//#   pin: rxpin digital in
//#   pin: txpin digital out
//#   fidelity: exact at the pins of the console (on an Uno AVR_PIN('D', 0) and 1); at any others the terminal is not wired
//#   mcu: atmega328p
//#   limit: the terminal cannot move to other pins
static inline terminal *simpleterm_reopen(int32_t rxpin, int32_t txpin, int32_t mode, int32_t baud) {
  bool wired = rxpin == 24 && txpin == 25;
  usart_flush();
  if (wired) usart_open(baud);
  console.open = wired;
  console.terminalEcho = console.terminalEcho || mode & ECHO_RX_TO_TX;
  dport_ptr = &console;
  return dport_ptr;
}

//# adapter simpleterm_set
//#   for: void simpleterm_set(text_t *ptr)
//#   kind: oneToMany
//#   needs: text_t dport_ptr simpleterm_close
//#   fidelity: exact
static inline void simpleterm_set(text_t *ptr) {
  simpleterm_close();
  dport_ptr = ptr;
}

//# adapter writeByte
//#   for: void writeByte(text_t *p, char c)
//#   kind: oneToOne
//#   needs: text_t line_write usart_registers
//#   fidelity: exact: the byte as it is
static inline void writeByte(text_t *p, char c) {
  if (p && p->line) line_write(p->line, c);
  else if (p && p->open) usart_put(c);
}

//# adapter writeChar
//#   for: void writeChar(text_t *device, char c)
//#   kind: oneToMany
//#   needs: text_t writeByte
//#   fidelity: exact: one that ends a line is sent as the device's line end
static inline void writeChar(text_t *device, char c) {
  if (!device) return;
  if (c != device->ecA && c != device->ecB) {
    writeByte(device, c);
    return;
  }
  if (device->ecsA) writeByte(device, device->ecsA);
  if (device->ecsB) writeByte(device, device->ecsB);
}

//# adapter putByte
//#   for: void putByte(char c)
//#   kind: oneToOne
//#   needs: dport_ptr writeByte
//#   fidelity: exact
static inline void putByte(char c) {
  writeByte(dport_ptr, c);
}

//# adapter putChar
//#   for: void putChar(char c)
//#   kind: oneToOne
//#   needs: dport_ptr writeChar
//#   fidelity: exact but for line ends
static inline void putChar(char c) {
  writeChar(dport_ptr, c);
}

//# adapter readByte
//#   for: int readByte(text_t *text)
//#   kind: oneToMany
//#   needs: text_t line_read usart_registers
//#   fidelity: it waits; 0 to 255. Bytes that came before the call are kept here, 64 of them, and lost there
static inline int32_t readByte(text_t *text) {
  if (!text || !(text->open || text->line)) return 0;
  int16_t byte;
  while ((byte = text->line ? line_read(text->line) : usart_get()) < 0) {}
  return byte;
}

//# adapter readChar
//#   for: int readChar(text_t *device)
//#   kind: oneToOne
//#   needs: text_t readByte
//#   fidelity: it waits; 0 to 255. Bytes that came before the call are kept here, 64 of them, and lost there
static inline int32_t readChar(text_t *device) {
  return readByte(device);
}

//# adapter getByte
//#   for: int getByte(void)
//#   kind: oneToOne
//#   needs: dport_ptr readByte
//#   fidelity: it waits; 0 to 255. Bytes that came before the call are kept here, 64 of them, and lost there
static inline int32_t getByte(void) {
  return readByte(dport_ptr);
}

//# adapter getChar
//#   for: int getChar(void)
//#   kind: oneToOne
//#   needs: dport_ptr readByte
//#   fidelity: it waits; 0 to 255. Bytes that came before the call are kept here, 64 of them, and lost there
static inline int32_t getChar(void) {
  return readByte(dport_ptr);
}

//# helper TextOut
//#   needs: text_t writeChar
//#   fidelity: where a text goes, a device or memory; it counts its characters. A character 0 ends what a device gets, as there
typedef struct {
  text_t *device;
  char *memory;
  int32_t count;
  bool ended;
} TextOut;

static inline TextOut text_to(text_t *device) {
  TextOut out = {device, 0, 0, false};
  return out;
}

static inline TextOut text_into(char *memory) {
  TextOut out = {0, memory, 0, false};
  return out;
}

static inline void out_put(TextOut *out, char c) {
  if (out->memory) out->memory[out->count] = c;
  else if (!c) out->ended = true;
  else if (!out->ended) writeChar(out->device, c);
  out->count++;
}

static inline void out_text(TextOut *out, const char *text) {
  while (*text) out_put(out, *text++);
}

static inline void out_fill(TextOut *out, int32_t times, char c) {
  for (; times > 0; times--) out_put(out, c);
}

static inline void out_number(TextOut *out, uint32_t value, uint8_t base, int32_t width, char filler) {
  char digits[33], *first = digits + 32;
  *first = 0;
  do *--first = "0123456789abcdef"[value % base];
  while (value /= base);
  out_fill(out, width - (digits + 32 - first), filler);
  out_text(out, first);
}

//# adapter float2string
//#   include: <math.h> <string.h> <ctype.h>
//#   for: char *float2string(float f, char *s, int width, int precision)
//#   kind: semantic
//#   fidelity: exact, digit by digit in the same steps: 6 decimal places at most, and a carry does not add a digit, so that 9.96 with one
//#   fidelity: place is 0.0
static inline char *float2string(float f, char *s, int32_t width, int32_t precision) {
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
static inline void write_float(TextOut out, float value, int32_t width, int32_t precision) {
  char text[72];
  out_text(&out, float2string(value, text, width > 20 ? 20 : width, precision));
}

//# adapter printNumber
//#   for: int printNumber(text_t *p, unsigned long u, int base, int width, int fill_char)
//#   kind: semantic
//#   needs: text_t TextOut
//#   fidelity: exact: base 2 to 16; the number of characters
static inline int32_t printNumber(text_t *device, uint32_t u, int32_t base, int32_t width, int32_t fill_char) {
  TextOut out = text_to(device);
  out_number(&out, u, (uint8_t)base, width, (char)fill_char);
  return out.count;
}

//# adapter writeStr
//#   for: int writeStr(text_t *device, const char *str)
//#   kind: oneToMany
//#   needs: text_t TextOut
//#   fidelity: exact but for line ends
static inline int32_t writeStr(text_t *device, const char *str) {
  TextOut out = text_to(device);
  out_text(&out, str);
  return out.count;
}

//# adapter putStr
//#   for: int putStr(const char *str)
//#   kind: oneToOne
//#   needs: dport_ptr writeStr
//#   fidelity: exact but for line ends
static inline int32_t putStr(const char *str) {
  return writeStr(dport_ptr, str);
}

//# adapter writeLine
//#   for: int writeLine(text_t *device, const char *str)
//#   kind: oneToMany
//#   needs: text_t TextOut writeChar
//#   fidelity: exact but for line ends
static inline int32_t writeLine(text_t *device, const char *str) {
  TextOut out = text_to(device);
  out_text(&out, str);
  if (device) writeChar(device, device->ecA);
  return out.count;
}

//# adapter putLine
//#   for: int putLine(const char *str)
//#   kind: oneToOne
//#   needs: dport_ptr writeLine
//#   fidelity: exact but for line ends
static inline int32_t putLine(const char *str) {
  return writeLine(dport_ptr, str);
}

//# adapter putln
//#   for: int putln(const char *str)
//#   kind: oneToOne
//#   needs: putLine
//#   fidelity: exact but for line ends
static inline int32_t putln(const char *str) {
  return putLine(str);
}

//# adapter writeStrLen
//#   include: <ctype.h>
//#   for: int writeStrLen(text_t *device, char *str, int width)
//#   kind: oneToMany
//#   needs: text_t TextOut
//#   fidelity: exact but for line ends: letters and digits count for the width, and no more than it are sent
static inline int32_t writeStrLen(text_t *device, const char *str, int32_t width) {
  TextOut out = text_to(device);
  int32_t letters = 0;
  while (isalnum((uint8_t)str[letters])) letters++;
  out_fill(&out, width - letters, ' ');
  for (int32_t left = width; *str && left > 0; left--) out_put(&out, *str++);
  return letters > width ? letters : width;
}

//# adapter putStrLen
//#   for: int putStrLen(char *str, int width)
//#   kind: oneToOne
//#   needs: dport_ptr writeStrLen
//#   fidelity: exact but for line ends: letters and digits count for the width, and no more than it are sent
static inline int32_t putStrLen(const char *str, int32_t width) {
  return writeStrLen(dport_ptr, str, width);
}

//# adapter writeDec
//#   include: <stdlib.h>
//#   for: void writeDec(text_t *device, int value)
//#   kind: oneToMany
//#   needs: text_t writeChar printNumber
//#   fidelity: exact
static inline void writeDec(text_t *device, int32_t value) {
  if (value < 0) writeChar(device, '-');
  printNumber(device, labs(value), 10, 0, ' ');
}

//# adapter putDec
//#   for: void putDec(int value)
//#   kind: oneToOne
//#   needs: dport_ptr writeDec
//#   fidelity: exact
static inline void putDec(int32_t value) {
  writeDec(dport_ptr, value);
}

//# adapter writeDecLen
//#   include: <stdlib.h>
//#   for: void writeDecLen(text_t *device, int value, int width)
//#   kind: oneToMany
//#   needs: text_t writeChar printNumber
//#   fidelity: exact: a minus sign comes before the padding, and the width does not count it
static inline void writeDecLen(text_t *device, int32_t value, int32_t width) {
  if (value < 0) writeChar(device, '-');
  printNumber(device, labs(value), 10, width, ' ');
}

//# adapter putDecLen
//#   include: <stdlib.h>
//#   for: void putDecLen(int value, int width)
//#   kind: oneToMany
//#   needs: dport_ptr writeChar printNumber
//#   fidelity: exact: a minus sign comes before the padding, and the width does not count it
static inline void putDecLen(int32_t value, int32_t width) {
  if (value < 0) writeChar(dport_ptr, '-');
  printNumber(dport_ptr, labs(value), 10, width, '0');
}

//# adapter writeBin
//#   for: void writeBin(text_t *device, int value)
//#   kind: oneToMany
//#   needs: text_t printNumber
//#   fidelity: exact
static inline void writeBin(text_t *device, int32_t value) {
  printNumber(device, value, 2, 0, ' ');
}

//# adapter putBin
//#   for: void putBin(int value)
//#   kind: oneToOne
//#   needs: dport_ptr writeBin
//#   fidelity: exact
static inline void putBin(int32_t value) {
  writeBin(dport_ptr, value);
}

//# adapter writeBinLen
//#   for: void writeBinLen(text_t *device, int value, int digits)
//#   kind: oneToMany
//#   needs: text_t printNumber
//#   fidelity: exact
static inline void writeBinLen(text_t *device, int32_t value, int32_t digits) {
  printNumber(device, value, 2, digits, ' ');
}

//# adapter putBinLen
//#   for: void putBinLen(int value, int digits)
//#   kind: oneToMany
//#   needs: dport_ptr printNumber
//#   fidelity: exact
static inline void putBinLen(int32_t value, int32_t digits) {
  printNumber(dport_ptr, value, 2, digits, '0');
}

//# adapter writeHex
//#   for: void writeHex(text_t *device, int value)
//#   kind: oneToMany
//#   needs: text_t printNumber
//#   fidelity: exact
static inline void writeHex(text_t *device, int32_t value) {
  printNumber(device, value, 16, 0, ' ');
}

//# adapter putHex
//#   for: void putHex(int value)
//#   kind: oneToOne
//#   needs: dport_ptr writeHex
//#   fidelity: exact
static inline void putHex(int32_t value) {
  writeHex(dport_ptr, value);
}

//# adapter writeHexLen
//#   for: void writeHexLen(text_t *device, int value, int digits)
//#   kind: oneToMany
//#   needs: text_t printNumber
//#   fidelity: exact
static inline void writeHexLen(text_t *device, int32_t value, int32_t digits) {
  printNumber(device, value, 16, digits, ' ');
}

//# adapter putHexLen
//#   for: void putHexLen(int value, int digits)
//#   kind: oneToMany
//#   needs: dport_ptr printNumber
//#   fidelity: exact
static inline void putHexLen(int32_t value, int32_t digits) {
  printNumber(dport_ptr, value, 16, digits, '0');
}

//# adapter writeFloat
//#   for: void writeFloat(text_t *device, float value)
//#   kind: oneToMany
//#   needs: text_t TextOut write_float
//#   fidelity: exact: 6 decimal places
static inline void writeFloat(text_t *device, float value) {
  write_float(text_to(device), value, 1, 10);
}

//# adapter putFloat
//#   for: void putFloat(float value)
//#   kind: oneToMany
//#   needs: dport_ptr TextOut write_float
//#   fidelity: exact: 6 decimal places
static inline void putFloat(float value) {
  write_float(text_to(dport_ptr), value, 4, 10);
}

//# adapter writeFloatPrecision
//#   for: void writeFloatPrecision(text_t *device, float value, int width, int precision)
//#   kind: oneToMany
//#   needs: text_t TextOut write_float
//#   fidelity: exact up to a width of 20
static inline void writeFloatPrecision(text_t *device, float value, int32_t width, int32_t precision) {
  write_float(text_to(device), value, width, precision);
}

//# adapter putFloatPrecision
//#   for: void putFloatPrecision(float value, int width, int precision)
//#   kind: oneToOne
//#   needs: dport_ptr writeFloatPrecision
//#   fidelity: exact up to a width of 20
static inline void putFloatPrecision(float value, int32_t width, int32_t precision) {
  writeFloatPrecision(dport_ptr, value, width, precision);
}

//# adapter putStrWithNpcVals
//#   for: int putStrWithNpcVals(const char *s)
//#   kind: oneToMany
//#   needs: dport_ptr TextOut
//#   fidelity: exact but for line ends
static inline int32_t putStrWithNpcVals(const char *s) {
  TextOut out = text_to(dport_ptr);
  for (const char *at = s;; at++) {
    if (*at >= ' ' && *at <= '~') {
      out_put(&out, *at);
      continue;
    }
    out_put(&out, '[');
    out_number(&out, (uint8_t)*at, 10, 0, ' ');
    out_put(&out, ']');
    if (*at == '\n' || *at == '\r') out_put(&out, *at);
    if (!*at) return at - s;
  }
}

//# helper TextArgument
//#   fidelity: an argument of print as it is there: 32 bits of integer, a float or a text
typedef struct {
  char kind;  // 'd', 'f' or 's'
  union {
    int32_t integer;
    float real;
    const char *text;
  };
} TextArgument;

static inline TextArgument text_of_number(int32_t value) {
  return (TextArgument){.kind = 'd', .integer = value};
}

static inline TextArgument text_of_char(char value) {
  return text_of_number((uint8_t)value);  // plain char has no sign there
}

static inline TextArgument text_of_real(float value) {
  return (TextArgument){.kind = 'f', .real = value};
}

static inline TextArgument text_of_text(const void *value) {
  return (TextArgument){.kind = 's', .text = value};
}

static inline int32_t text_number(const TextArgument *argument) {
  return argument->kind == 'f' ? (int32_t)argument->real : argument->integer;
}

#define TEXT_ARGUMENT(x) \
  _Generic((x), float: text_of_real, double: text_of_real, char: text_of_char, char *: text_of_text, const char *: text_of_text, \
           unsigned char *: text_of_text, const unsigned char *: text_of_text, default: text_of_number)(x)
#define TEXT_0(x)
#define TEXT_1(x) , TEXT_ARGUMENT(x)
#define TEXT_2(x, ...) , TEXT_ARGUMENT(x) TEXT_1(__VA_ARGS__)
#define TEXT_3(x, ...) , TEXT_ARGUMENT(x) TEXT_2(__VA_ARGS__)
#define TEXT_4(x, ...) , TEXT_ARGUMENT(x) TEXT_3(__VA_ARGS__)
#define TEXT_5(x, ...) , TEXT_ARGUMENT(x) TEXT_4(__VA_ARGS__)
#define TEXT_6(x, ...) , TEXT_ARGUMENT(x) TEXT_5(__VA_ARGS__)
#define TEXT_7(x, ...) , TEXT_ARGUMENT(x) TEXT_6(__VA_ARGS__)
#define TEXT_8(x, ...) , TEXT_ARGUMENT(x) TEXT_7(__VA_ARGS__)
#define TEXT_9(x, ...) , TEXT_ARGUMENT(x) TEXT_8(__VA_ARGS__)
#define TEXT_10(x, ...) , TEXT_ARGUMENT(x) TEXT_9(__VA_ARGS__)
#define TEXT_11(x, ...) , TEXT_ARGUMENT(x) TEXT_10(__VA_ARGS__)
#define TEXT_12(x, ...) , TEXT_ARGUMENT(x) TEXT_11(__VA_ARGS__)
#define TEXT_13(x, ...) , TEXT_ARGUMENT(x) TEXT_12(__VA_ARGS__)
#define TEXT_14(x, ...) , TEXT_ARGUMENT(x) TEXT_13(__VA_ARGS__)
#define TEXT_15(x, ...) , TEXT_ARGUMENT(x) TEXT_14(__VA_ARGS__)
#define TEXT_16(x, ...) , TEXT_ARGUMENT(x) TEXT_15(__VA_ARGS__)
#define TEXT_PICK(_0, _1, _2, _3, _4, _5, _6, _7, _8, _9, _10, _11, _12, _13, _14, _15, _16, picked, ...) picked
#define TEXT_COUNT(...) TEXT_PICK(0, ##__VA_ARGS__, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0)
#define TEXT_EACH(...) \
  TEXT_PICK(0, ##__VA_ARGS__, TEXT_16, TEXT_15, TEXT_14, TEXT_13, TEXT_12, TEXT_11, TEXT_10, TEXT_9, TEXT_8, TEXT_7, TEXT_6, TEXT_5, \
            TEXT_4, TEXT_3, TEXT_2, TEXT_1, TEXT_0)(__VA_ARGS__)
#define TEXT_ARGUMENTS(...) ((const TextArgument[]){{.kind = 'd'} TEXT_EACH(__VA_ARGS__)}), TEXT_COUNT(__VA_ARGS__)

//# helper format_text
//#   include: <ctype.h> <string.h> <stdlib.h>
//#   needs: TextOut TextArgument float2string
//#   fidelity: %d %u %x %b %c %s %f %%, with a 0, a width and a precision. As there, a text has no width, a minus sign comes before the
//#   fidelity: padding, and what is not known prints nothing and takes no argument
static inline int32_t format_text(bool floats, TextOut out, const char *format, const TextArgument *given, uint8_t count) {
  const TextArgument none = {.kind = 'd'}, *last = given++ + count + 1;  // in front of them stands one more
  for (; *format; format++) {
    if (*format != '%') {
      out_put(&out, *format);
      continue;
    }
    char filler = *++format == '0' ? '0' : ' ';
    int32_t width = 0, precision = 6;
    for (; isdigit((uint8_t)*format); format++) width = 10 * width + (*format - '0');
    if (*format == '.')
      for (precision = 0; isdigit((uint8_t)*++format);) precision = 10 * precision + (*format - '0');
    if (!*format) break;
    if (*format == '%') out_put(&out, '%');
    if (!strchr(floats ? "bcdfsux" : "bcdsux", *format)) continue;
    const TextArgument *argument = given < last ? given++ : &none;
    int32_t number = text_number(argument);
    switch (*format) {
      case 'c': out_put(&out, (char)number); break;
      case 's': out_text(&out, argument->kind == 's' ? argument->text : ""); break;
      case 'b': out_number(&out, number, 2, width, filler); break;
      case 'x': out_number(&out, number, 16, width, filler); break;
      case 'u': out_number(&out, number, 10, width, filler); break;
      case 'd':
        if (number < 0) out_put(&out, '-');
        out_number(&out, labs(number), 10, width - (number < 0), filler);
        break;
      default: {
        char text[72];
        out_text(&out, float2string(argument->kind == 'f' ? argument->real : number, text, width > 20 ? 20 : width, precision));
      }
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
//#   limit: at most 16 arguments behind the format
#define print(format, ...) format_text(true, text_to(dport_ptr), format, TEXT_ARGUMENTS(__VA_ARGS__))

//# adapter printi
//#   for: int printi(const char *format, ...)
//#   kind: semantic
//#   needs: dport_ptr TextOut TextArgument format_text
//#   fidelity: exact but for line ends, in 32 bits; %f prints nothing, as there; texts of more than 255 characters, which overflow a buffer there, are printed
//#   limit: at most 16 arguments behind the format
#define printi(format, ...) format_text(false, text_to(dport_ptr), format, TEXT_ARGUMENTS(__VA_ARGS__))

//# adapter dprint
//#   for: int dprint(text_t *device, const char *format, ...)
//#   kind: semantic
//#   needs: TextOut TextArgument format_text
//#   fidelity: exact but for line ends, in 32 bits; texts of more than 255 characters, which overflow a buffer there, are printed
//#   limit: at most 16 arguments behind the format
#define dprint(device, format, ...) format_text(true, text_to(device), format, TEXT_ARGUMENTS(__VA_ARGS__))

//# adapter dprinti
//#   for: int dprinti(text_t *device, const char *format, ...)
//#   kind: semantic
//#   needs: TextOut TextArgument format_text
//#   fidelity: exact but for line ends, in 32 bits; %f prints nothing, as there; texts of more than 255 characters, which overflow a buffer there, are printed
//#   limit: at most 16 arguments behind the format
#define dprinti(device, format, ...) format_text(false, text_to(device), format, TEXT_ARGUMENTS(__VA_ARGS__))

//# adapter sprint
//#   for: int sprint(char *buffer, const char *format, ...)
//#   kind: semantic
//#   needs: TextOut TextArgument format_text
//#   fidelity: exact, in 32 bits
//#   limit: at most 16 arguments behind the format
#define sprint(buffer, format, ...) format_text(true, text_into(buffer), format, TEXT_ARGUMENTS(__VA_ARGS__))

//# adapter sprinti
//#   for: int sprinti(char *buffer, const char *format, ...)
//#   kind: semantic
//#   needs: TextOut TextArgument format_text
//#   fidelity: exact, in 32 bits; %f prints nothing, as there
//#   limit: at most 16 arguments behind the format
#define sprinti(buffer, format, ...) format_text(false, text_into(buffer), format, TEXT_ARGUMENTS(__VA_ARGS__))

//# adapter readStr
//#   for: char *readStr(text_t *device, char *buffer, int max)
//#   kind: oneToMany
//#   needs: text_t readByte writeByte
//#   fidelity: exact: up to a line end, or `max` characters and a 0 behind them; echo and backspace only when echo is on
//#   limit: a terminal that ends lines with both CR and LF sends an empty line more, as there
static inline char *readStr(text_t *device, char *buffer, int32_t max) {
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
static inline char *getStr(char *buffer, int32_t max) {
  return readStr(dport_ptr, buffer, max);
}

//# helper scan_integer
//#   include: <string.h> <ctype.h>
//#   fidelity: leaves out what cannot begin a number; 0 without one. As there, a digit that ends a width is read again
static inline const char *scan_integer(const char *text, int32_t *value, uint8_t base, uint8_t width, bool sign) {
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
//#   include: <string.h> <ctype.h>
//#   for: float string2float(char *s, char **end)
//#   kind: semantic
//#   fidelity: exact, in the same steps; it leaves out what cannot begin a number, and there is no exponent
static inline float string2float(const char *s, char **end) {
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
static inline int32_t readDec(text_t *device) {
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
static inline int32_t getDec(void) {
  return readDec(dport_ptr);
}

//# adapter readBin
//#   for: int readBin(text_t *device)
//#   kind: oneToMany
//#   needs: text_t readStr scan_integer
//#   fidelity: exact; 0 for a line without a number
static inline int32_t readBin(text_t *device) {
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
static inline int32_t getBin(void) {
  return readBin(dport_ptr);
}

//# adapter readHex
//#   for: int readHex(text_t *device)
//#   kind: oneToMany
//#   needs: text_t readStr scan_integer
//#   fidelity: exact; 0 for a line without a number
static inline int32_t readHex(text_t *device) {
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
static inline int32_t getHex(void) {
  return readHex(dport_ptr);
}

//# adapter readFloat
//#   for: float readFloat(text_t *device)
//#   kind: oneToMany
//#   needs: text_t readStr string2float
//#   fidelity: exact; 0 for a line without a number
static inline float readFloat(text_t *device) {
  char line[21], *end;
  return string2float(readStr(device, line, 20), &end);
}

//# adapter getFloat
//#   for: float getFloat(void)
//#   kind: oneToOne
//#   needs: dport_ptr readFloat
//#   fidelity: exact; 0 for a line without a number
static inline float getFloat(void) {
  return readFloat(dport_ptr);
}

//# helper ScanTarget
//#   include: <string.h>
//#   fidelity: a variable that scan fills, of the size that it has here
typedef struct {
  void *at;
  uint8_t size;
  bool real;
} ScanTarget;

static inline void scan_integer_into(const ScanTarget *target, int32_t value) {
  memcpy(target->at, &value, target->size < 4 ? target->size : 4);
}

static inline void scan_real_into(const ScanTarget *target, float value) {
  if (target->real || target->size == sizeof value) memcpy(target->at, &value, sizeof value);
}

#define SCAN_TARGET(x) {(void *)(x), sizeof *(x), _Generic((x), float *: true, double *: true, default: false)}
#define SCAN_0(x)
#define SCAN_1(x) , SCAN_TARGET(x)
#define SCAN_2(x, ...) , SCAN_TARGET(x) SCAN_1(__VA_ARGS__)
#define SCAN_3(x, ...) , SCAN_TARGET(x) SCAN_2(__VA_ARGS__)
#define SCAN_4(x, ...) , SCAN_TARGET(x) SCAN_3(__VA_ARGS__)
#define SCAN_5(x, ...) , SCAN_TARGET(x) SCAN_4(__VA_ARGS__)
#define SCAN_6(x, ...) , SCAN_TARGET(x) SCAN_5(__VA_ARGS__)
#define SCAN_7(x, ...) , SCAN_TARGET(x) SCAN_6(__VA_ARGS__)
#define SCAN_8(x, ...) , SCAN_TARGET(x) SCAN_7(__VA_ARGS__)
#define SCAN_PICK(_0, _1, _2, _3, _4, _5, _6, _7, _8, picked, ...) picked
#define SCAN_COUNT(...) SCAN_PICK(0, ##__VA_ARGS__, 8, 7, 6, 5, 4, 3, 2, 1, 0)
#define SCAN_EACH(...) SCAN_PICK(0, ##__VA_ARGS__, SCAN_8, SCAN_7, SCAN_6, SCAN_5, SCAN_4, SCAN_3, SCAN_2, SCAN_1, SCAN_0)(__VA_ARGS__)
#define SCAN_TARGETS(...) ((const ScanTarget[]){{0, 0, false} SCAN_EACH(__VA_ARGS__)}), SCAN_COUNT(__VA_ARGS__)

//# helper scan_text
//#   include: <ctype.h> <string.h>
//#   needs: ScanTarget scan_integer string2float
//#   fidelity: %d %u %x %b %f %s %c %%, with a width; the number of variables filled. It stops at the end of a text, where the library reads on
static inline int32_t scan_text(bool floats, const char *text, const char *format, const ScanTarget *targets, uint8_t count) {
  const ScanTarget *last = targets++ + count + 1;  // in front of them stands one more
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
    const ScanTarget *target = targets++;
    if (c == 'c' || c == 's') {
      char *to = (char *)target->at;
      if (c == 'c' && width == 255) width = 1;
      for (; width && *text && (c == 'c' || !isspace((uint8_t)*text)); width--) *to++ = *text++;
      if (c == 's') *to = 0;
    } else if (floats && strchr("efg", c)) {
      char *end;
      scan_real_into(target, string2float(text, &end));  // 0 for a text without a number, and "5." is 5, as there
      text = end;
    } else {
      int32_t value;
      text = scan_integer(text, &value, c == 'b' ? 2 : c == 'x' ? 16 : 10, width, c == 'd' || c == 'b');
      if (!text) break;
      scan_integer_into(target, value);
    }
    filled++;
  }
  return filled;
}

//# helper scan_line
//#   needs: text_t readStr
//#   ram: 81
static char scan_buffer[81];

static inline const char *scan_line(text_t *device) {
  return readStr(device, scan_buffer, 80);
}

//# adapter scan
//#   for: int scan(const char *fmt, ...)
//#   kind: semantic
//#   needs: dport_ptr scan_line ScanTarget scan_text
//#   fidelity: exact: the number of variables filled; integers of any width are filled
//#   limit: a line of more than 80 characters is taken in parts; there 256
//#   limit: at most 8 variables
#define scan(fmt, ...) scan_text(true, scan_line(dport_ptr), fmt, SCAN_TARGETS(__VA_ARGS__))

//# adapter scani
//#   for: int scani(const char *fmt, ...)
//#   kind: semantic
//#   needs: dport_ptr scan_line ScanTarget scan_text
//#   fidelity: exact: the number of variables filled; integers of any width are filled; no %f, as there
//#   limit: a line of more than 80 characters is taken in parts; there 256
//#   limit: at most 8 variables
#define scani(fmt, ...) scan_text(false, scan_line(dport_ptr), fmt, SCAN_TARGETS(__VA_ARGS__))

//# adapter dscan
//#   for: int dscan(text_t *device, const char *fmt, ...)
//#   kind: semantic
//#   needs: scan_line ScanTarget scan_text
//#   fidelity: exact: the number of variables filled; integers of any width are filled
//#   limit: a line of more than 80 characters is taken in parts; there 256
//#   limit: at most 8 variables
#define dscan(device, fmt, ...) scan_text(true, scan_line(device), fmt, SCAN_TARGETS(__VA_ARGS__))

//# adapter dscani
//#   for: int dscani(text_t *device, const char *fmt, ...)
//#   kind: semantic
//#   needs: scan_line ScanTarget scan_text
//#   fidelity: exact: the number of variables filled; integers of any width are filled; no %f, as there
//#   limit: a line of more than 80 characters is taken in parts; there 256
//#   limit: at most 8 variables
#define dscani(device, fmt, ...) scan_text(false, scan_line(device), fmt, SCAN_TARGETS(__VA_ARGS__))

//# adapter sscan
//#   for: int sscan(const char *buffer, const char *fmt, ...)
//#   kind: semantic
//#   needs: ScanTarget scan_text
//#   fidelity: exact: the number of variables filled; integers of any width are filled
//#   limit: at most 8 variables
#define sscan(buffer, fmt, ...) scan_text(true, buffer, fmt, SCAN_TARGETS(__VA_ARGS__))

//# adapter sscani
//#   for: int sscani(const char *buffer, const char *fmt, ...)
//#   kind: semantic
//#   needs: ScanTarget scan_text
//#   fidelity: exact: the number of variables filled; integers of any width are filled; no %f, as there
//#   limit: at most 8 variables
#define sscani(buffer, fmt, ...) scan_text(false, buffer, fmt, SCAN_TARGETS(__VA_ARGS__))

//# adapter sscanAfterStr
//#   include: <string.h>
//#   for: int sscanAfterStr(char *buffer, char *str, char *fmt, ...)
//#   kind: semantic
//#   needs: ScanTarget scan_text
//#   fidelity: exact: the number of variables filled; integers of any width are filled; 0 when the text is not there
//#   limit: at most 8 variables
static inline const char *scan_behind(const char *buffer, const char *str) {
  const char *found = strstr(buffer, str);
  return found ? found + strlen(str) : 0;
}
#define sscanAfterStr(buffer, str, fmt, ...) scan_text(true, scan_behind(buffer, str), fmt, SCAN_TARGETS(__VA_ARGS__))
