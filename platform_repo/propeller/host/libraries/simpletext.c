/* simpletext.h and serial.h: text to and from terminals and half-duplex serial lines. Sources: libsimpletext (dosprint.c, doscanf.c,
 * printNumber.c, floatToString.c, stringToFloat.c, safe_gets.c, serial_*.c, simpleterm*.c, put*.c, write*.c, get*.c). */
#include "simpletools.h"

enum { CONSOLE_RX = 31, CONSOLE_TX = 30, CONSOLE_BAUD = 115200, PRINT_BYTES = 256 };

/* ---- serial lines: the terminal's is the console, others are bits at pins */

static Serial_t console_line = {CONSOLE_RX, CONSOLE_TX, 0, CONSOLE_BAUD, HOST_HZ / CONSOLE_BAUD};
static text_t console = {serial_rxChar, serial_txChar, {0}, &console_line, 0, '\r', '\n', '\r', 0};
text_t *dport_ptr = &console;

static int is_console(const Serial_t *line) { return line->rx_pin == CONSOLE_RX && line->tx_pin == CONSOLE_TX; }

serial *serial_open(int rxpin, int txpin, int mode, int baudrate) {
  host_call();
  text_t *text = calloc(1, sizeof *text);
  Serial_t *line = calloc(1, sizeof *line);
  if (!text || !line || baudrate <= 0) return 0;
  *line = (Serial_t){rxpin, txpin, mode, baudrate, (int)CLKFREQ / baudrate};
  *text = (text_t){serial_rxChar, serial_txChar, {0}, line, (mode & ECHO_RX_TO_TX) != 0, 0, 0, 0, 0};
  if (is_console(line)) {
    text->ecA = text->ecsA = '\r';
    text->ecB = '\n';
    return text;
  }
  if (txpin >= SERIAL_MIN_PIN && txpin <= SERIAL_MAX_PIN) {
    OUTA |= 1u << txpin;
    DIRA |= 1u << txpin;
  }
  if (rxpin >= SERIAL_MIN_PIN && rxpin <= SERIAL_MAX_PIN) DIRA &= ~(1u << rxpin);
  return text;
}

void serial_close(serial *device) {
  host_call();
  if (!device) return;
  Serial_t *line = (Serial_t *)device->devst;
  if (!is_console(line)) {
    OUTA &= ~(1u << (line->tx_pin & 31));
    DIRA &= ~(1u << (line->tx_pin & 31)) & ~(1u << (line->rx_pin & 31));
  }
  if (device == &console) return;
  free(line);
  free(device);
}

int serial_rxChar(serial *device) {
  Serial_t *line = (Serial_t *)device->devst;
  host_call();
  if (is_console(line)) return host_console_read(HOST_NEVER);
  unsigned mask = 1u << (line->rx_pin & 31), byte = 0;
  DIRA &= ~mask;
  host_wait_pins(mask, 0, 1, HOST_NEVER);
  host_time sample = host_now() + line->ticks + line->ticks / 2;
  for (int bit = 0; bit < 8; bit++, sample += line->ticks) {
    host_spend(sample - host_now());
    byte |= (host_pins() & mask ? 1u : 0u) << bit;
  }
  host_wait_pins(mask, mask, 1, HOST_NEVER);
  return byte;
}

int serial_txChar(serial *device, int txbyte) {
  Serial_t *line = (Serial_t *)device->devst;
  if (is_console(line)) {
    host_send_for(10 * line->ticks);
    host_console_write(txbyte);
    return txbyte;
  }
  unsigned mask = 1u << (line->tx_pin & 31), frame = (txbyte | 0x100) << 1;
  host_call();
  DIRA |= mask;
  for (int bit = 0; bit < 10; bit++, frame >>= 1) {
    OUTA = frame & 1 ? OUTA | mask : OUTA & ~mask;
    host_spend(line->ticks);
  }
  return txbyte;
}

/* ---- the terminal */

static int echo_before;
static char codes_before[4] = {'\r', '\n', '\r', 0};

/* At the start the library opens it before main begins; opened again it takes a second. */
terminal *simpleterm_open(void) {
  if (dport_ptr) return dport_ptr;
  dport_ptr = serial_open(CONSOLE_RX, CONSOLE_TX, 0, CONSOLE_BAUD);
  host_sleep_until(host_now() + HOST_HZ);
  return dport_ptr;
}

void simpleterm_close(void) {
  text_t *text = dport_ptr;
  if (!text) return;
  echo_before = text->terminalEcho;
  codes_before[0] = text->ecA, codes_before[1] = text->ecB, codes_before[2] = text->ecsA, codes_before[3] = text->ecsB;
  serial_close(text);
  dport_ptr = 0;
}

terminal *simpleterm_reopen(int rxpin, int txpin, int mode, int baud) {
  simpleterm_close();
  dport_ptr = serial_open(rxpin, txpin, echo_before ? mode | ECHO_RX_TO_TX : mode, baud);
  set_endChars(dport_ptr, codes_before[0], codes_before[1]);
  set_endCharSequence(dport_ptr, codes_before[2], codes_before[3]);
  return dport_ptr;
}

void simpleterm_set(text_t *ptr) {
  simpleterm_close();
  dport_ptr = ptr;
}

terminal *simpleterm_pointer(void) { return dport_ptr; }

/* The terminal that is open. A program that closed it and goes on writing reaches for address 0. */
static text_t *terminal_now(void) {
  if (!dport_ptr) host_end("crashed", "writes to a terminal that is closed");
  return dport_ptr;
}

void set_endChars(text_t *text, char cA, char cB) { text->ecA = cA, text->ecB = cB; }
void set_endCharSequence(text_t *text, char cA, char cB) { text->ecsA = cA, text->ecsB = cB; }
void terminal_setEcho(text_t *text, int state) { text->terminalEcho = state; }
int terminal_checkEcho(text_t *text) { return text->terminalEcho; }

/* ---- one character */

int readByte(text_t *device) { return device->rxChar(device); }
int readChar(text_t *device) { return device->rxChar(device); }
int getByte(void) { return readByte(terminal_now()); }
int getChar(void) { return readChar(terminal_now()); }
void writeByte(text_t *device, char c) { device->txChar(device, c); }
void putByte(char c) { writeByte(terminal_now(), c); }

/* One of the two end characters goes out as the end sequence. */
void writeChar(text_t *device, char c) {
  if (c != device->ecA && c != device->ecB) {
    device->txChar(device, c);
    return;
  }
  char first = device->ecsA, second = device->ecsB;
  if (first) device->txChar(device, first);
  if (second) device->txChar(device, second);
}

void putChar(char c) { writeChar(terminal_now(), c); }

/* ---- text and numbers out */

int writeStr(text_t *device, char *str) {
  int count = 0;
  for (; str[count]; count++) writeChar(device, str[count]);
  return count;
}

int putStr(const char *str) { return writeStr(terminal_now(), (char *)str); }

int writeLine(text_t *device, char *str) {
  int count = writeStr(device, str);
  writeChar(device, device->ecA);
  return count;
}

int putln(const char *str) { return writeLine(terminal_now(), (char *)str); }
int putLine(const char *str) { return putln(str); }

/* The digits of a number in a base, last digit first; how many. */
static int digits_of(unsigned long value, int base, char *digits) {
  int count = 0;
  do digits[count++] = "0123456789abcdef"[value % base];
  while (value /= base);
  return count;
}

int printNumber(text_t *device, unsigned long value, int base, int width, int fill) {
  char digits[32];
  int count = digits_of(value, base, digits), written = 0;
  for (int i = count; i < width; i++, written++) device->txChar(device, fill);
  while (count) {
    device->txChar(device, digits[--count]);
    written++;
  }
  return written;
}

void writeDecLen(text_t *device, int value, int width) {
  if (value < 0) writeChar(device, '-');
  printNumber(device, value < 0 ? -(unsigned)value : (unsigned)value, 10, width, ' ');
}

void writeHexLen(text_t *device, int value, int digits) { printNumber(device, (unsigned)value, 16, digits, ' '); }
void writeBinLen(text_t *device, int value, int digits) { printNumber(device, (unsigned)value, 2, digits, ' '); }
void writeDec(text_t *device, int value) { writeDecLen(device, value, 1); }
void writeHex(text_t *device, int value) { writeHexLen(device, value, 1); }
void writeBin(text_t *device, int value) { writeBinLen(device, value, 1); }
void putDec(int value) { writeDec(terminal_now(), value); }
void putHex(int value) { writeHex(terminal_now(), value); }
void putBin(int value) { writeBin(terminal_now(), value); }

/* Those of the terminal fill with zeros, those of a device with spaces. */
void putDecLen(int value, int width) {
  if (value < 0) putChar('-');
  printNumber(terminal_now(), value < 0 ? -(unsigned)value : (unsigned)value, 10, width, '0');
}

void putHexLen(int value, int digits) { printNumber(terminal_now(), (unsigned)value, 16, digits, '0'); }
void putBinLen(int value, int digits) { printNumber(terminal_now(), (unsigned)value, 2, digits, '0'); }

void writeFloatPrecision(text_t *device, float value, int width, int precision) {
  char text[60];
  writeStr(device, float2string(value, text, width, precision));
}

void writeFloat(text_t *device, float value) { writeFloatPrecision(device, value, 1, 10); }
void putFloatPrecision(float value, int width, int precision) { writeFloatPrecision(terminal_now(), value, width, precision); }
void putFloat(float value) { putFloatPrecision(value, 4, 10); }

/* The width counts letters and digits up to the first other character; no more than `width` characters go out. */
int writeStrLen(text_t *device, char *str, int width) {
  int count = 0;
  while (isalnum(str[count])) count++;
  for (; count < width; count++) writeChar(device, ' ');
  while (*str && width--) writeChar(device, *str++);
  return count;
}

int putStrLen(char *str, int width) { return writeStrLen(terminal_now(), str, width); }

int putStrWithNpcVals(const char *s) {
  int size = strlen(s);
  for (int i = 0; i <= size; i++) {
    if (s[i] >= ' ' && s[i] <= '~') print("%c", s[i]);
    else print("[%d]", s[i]);
    if (s[i] == '\n' || s[i] == '\r') print("%c", s[i]);
  }
  return size;
}

/* ---- floating-point numbers, by the steps of the library in single precision: its digits differ from those of printf */

char *float2string(float value, char *s, int width, int precision) {
  enum { MOST_DIGITS = 6 };
  int at = 0;
  if (value != value) return strcpy(s, "nan");
  if (value != 0 && value + value == value) return strcpy(s, value < 0 ? "-inf" : "inf");
  if (precision > MOST_DIGITS) precision = MOST_DIGITS;
  if (value < 0) {
    s[at++] = '-';
    value = -value;
  }
  if (value < 1) s[at++] = '0';
  else {
    float scale = 1;
    int bits;
    memcpy(&bits, &value, 4);
    for (int turn = 0, turns = ((bits >> 23 & 0xFF) - 127) / 10; turn <= turns; turn++) scale *= 1000;
    while (scale >= 1 && value < scale) scale /= 10;
    for (; scale >= 1; scale /= 10) {
      int digit = (char)(value / scale);
      value -= digit * scale;
      s[at++] = '0' + digit;
    }
  }
  int missing = width - at - precision - (precision != 0);
  if (missing > 0) {
    memmove(s + missing, s, at);
    memset(s, ' ', missing);
    at += missing;
  }
  if (precision > 0) s[at++] = '.';
  for (int digit = 0; digit <= precision; digit++) {  /* one more than is shown, to round by */
    value *= 10;
    s[at++] = (char)value + '0';
    value -= (int)value;
  }
  int last = at - 1;
  if (s[last] >= '5')
    for (int i = last - 1; i >= 0; i--) {
      if (s[i] < '0' || s[i] > '9') continue;
      if (s[i] < '9') {
        s[i]++;
        break;
      }
      s[i] = '0';
    }
  s[last] = 0;
  return s;
}

float string2float(char *s, char **end) {
  float value = 0, sign = 1, part = 0.1;
  while (*s && !(*s == '-' || *s == '+' || *s == '.' || (*s >= '0' && *s <= '9'))) s++;
  if (*s == '-') sign = -1, s++;
  if (*s == '+') s++;
  for (; *s >= '0' && *s <= '9'; s++) value = 10 * value + (*s - '0');
  if (*s == '.')
    for (s++; *s >= '0' && *s <= '9'; s++, part /= 10) value += part * (*s - '0');
  *end = s;
  return value * sign;
}

/* ---- formats out: d u x b c s f %, 0 and a width before, .digits for f; an unknown letter prints nothing and takes no value */

static char *put_digits(char *to, unsigned long value, int base, int width, char fill) {
  char digits[32];
  int count = digits_of(value, base, digits);
  for (int i = count; i < width; i++) *to++ = fill;
  while (count) *to++ = digits[--count];
  return to;
}

static int format(char *to, const char *format, va_list values, int with_floats) {
  char *begin = to, number[60];
  for (char c; (c = *format++);) {
    if (c != '%') {
      *to++ = c;
      continue;
    }
    int width = 0, precision = 6;
    char fill = *format == '0' ? '0' : ' ';
    for (; isdigit(*format); format++) width = 10 * width + (*format - '0');
    if (*format == '.')
      for (format++, precision = 0; isdigit(*format); format++) precision = 10 * precision + (*format - '0');
    if (!(c = *format++)) break;
    if (c == '%') *to++ = c;
    else if (c == 'c') *to++ = va_arg(values, int);
    else if (c == 's') {
      const char *text = va_arg(values, char *);
      while (*text) *to++ = *text++;
    } else if (c == 'd') {
      int value = va_arg(values, int);
      if (value < 0) *to++ = '-', width--;
      to = put_digits(to, value < 0 ? -(unsigned)value : (unsigned)value, 10, width, fill);
    } else if (c == 'u' || c == 'x' || c == 'b') {
      to = put_digits(to, va_arg(values, unsigned), c == 'u' ? 10 : c == 'x' ? 16 : 2, width, fill);
    } else if (c == 'f' && with_floats) {
      int bits = host_double_bits(&values);
      float value;
      memcpy(&value, &bits, 4);
      strcpy(to, float2string(value, number, width, precision));
      to += strlen(to);
    }
  }
  *to = 0;
  return to - begin;
}

int _dosprnt(const char *text, va_list values, char *to) { return format(to, text, values, 1); }
int _intsprnt(const char *text, va_list values, char *to) { return format(to, text, values, 0); }

/* The library's buffer holds 256 characters; a longer text writes past it. */
static int print_to(text_t *device, const char *text, va_list values, int with_floats) {
  char buffer[8192];
  int count = format(buffer, text, values, with_floats);
  if (count >= PRINT_BYTES) host_end("crashed", "print makes a text that is longer than its buffer of 256 characters");
  writeStr(device, buffer);
  return count;
}

#define WITH_VALUES(last, result) \
  va_list values; va_start(values, last); int count = result; va_end(values); return count

int print(const char *format, ...) { WITH_VALUES(format, print_to(terminal_now(), format, values, 1)); }
int printi(const char *format, ...) { WITH_VALUES(format, print_to(terminal_now(), format, values, 0)); }
int dprint(text_t *device, const char *format, ...) { WITH_VALUES(format, print_to(device, format, values, 1)); }
int dprinti(text_t *device, const char *format, ...) { WITH_VALUES(format, print_to(device, format, values, 0)); }
int sprint(char *buffer, const char *format, ...) { WITH_VALUES(format, _dosprnt(format, values, buffer)); }
int sprinti(char *buffer, const char *format, ...) { WITH_VALUES(format, _intsprnt(format, values, buffer)); }

/* ---- lines and formats in */

char *_safe_gets(text_t *device, char *buffer, int count) {
  char *at = buffer;
  while (count-- > 0) {
    int c = device->rxChar(device);
    if (device->terminalEcho) {
      if (c == '\b' || c == 127) {
        if (at > buffer) {
          device->txChar(device, '\b'), device->txChar(device, ' '), device->txChar(device, '\b');
          count++, at--;
        }
        count++;
        continue;
      }
      writeChar(device, c);
    }
    if (c == '\r' || c == '\n') break;
    *at++ = c;
  }
  *at = 0;
  return buffer;
}

char *readStr(text_t *device, char *buffer, int max) { return _safe_gets(device, buffer, max); }
char *getStr(char *buffer, int max) { return readStr(terminal_now(), buffer, max); }

static int digit_value(int c, int base) {
  if (c >= '0' && c <= '9' && c - '0' < base) return c - '0';
  if (base == 16 && c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (base == 16 && c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

/* What stands before the number is skipped; binary digits may be parted by . and _. 0 when there is none. */
const char *_scanf_getl(const char *str, int *to, int base, unsigned width, int isSigned) {
  unsigned value = 0;
  int found = 0, negative = 0;
  while (*str && digit_value(*str, base) < 0 && !(base == 10 && (*str == '-' || *str == '+'))) str++;
  if (isSigned && (*str == '-' || *str == '+')) negative = *str++ == '-';
  for (; width; width--, str++) {
    int digit = digit_value(*str, base);
    if (digit < 0 && !(base == 2 && (*str == '.' || *str == '_'))) break;
    if (digit < 0) continue;
    found = 1;
    value = base * value + digit;
  }
  if (!found) return 0;
  *to = negative ? -value : value;
  return str;
}

const char *_scanf_getf(const char *str, float *to) {
  char *end;
  *to = string2float((char *)str, &end);
  return end;
}

static int read_number(text_t *device, int base, int is_signed, int size, unsigned width) {
  char line[40];
  int value = 0;
  if (*_safe_gets(device, line, size)) _scanf_getl(line, &value, base, width, is_signed);
  return value;
}

int readDec(text_t *device) { return read_number(device, 10, 1, 39, 11); }
int readHex(text_t *device) { return read_number(device, 16, 0, 12, 9); }
int readBin(text_t *device) { return read_number(device, 2, 0, 39, 32); }

float readFloat(text_t *device) {
  char line[25];
  float value = 0;
  if (*_safe_gets(device, line, 20)) _scanf_getf(line, &value);
  return value;
}

int getDec(void) { return readDec(terminal_now()); }
int getHex(void) { return readHex(terminal_now()); }
int getBin(void) { return readBin(terminal_now()); }
float getFloat(void) { return readFloat(terminal_now()); }

static const char *get_text(const char *str, char *to, unsigned width, int any) {
  while (width-- && *str && (any || !isspace(*str))) *to++ = *str++;
  if (!any) *to = 0;
  return str;
}

static int scan_text(const char *str, const char *format, va_list places, int with_floats) {
  int done = 0;
  for (char c; str && *str && (c = *format++);) {
    int width = -1;
    if (c != '%') {
      if (isspace(c)) while (isspace(*str)) str++;
      else if (*str++ != c) break;
      continue;
    }
    if (isdigit(*format)) format = _scanf_getl(format, &width, 10, 11, 0);
    c = *format++;
    if (c != 'c' && c != '%') {
      while (isspace(*str)) str++;
      if (!*str) break;
    }
    if (c == '%') {
      if (*str++ != '%') break;
      continue;
    }
    if (c == 'c') str = get_text(str, va_arg(places, char *), width == -1 ? 1 : width, 1);
    else if (c == 's') str = get_text(str, va_arg(places, char *), width, 0);
    else if (c == 'b') str = _scanf_getl(str, va_arg(places, int *), 2, width, 1);
    else if (c == 'd' || c == 'u') str = _scanf_getl(str, va_arg(places, int *), 10, width, c == 'd');
    else if (c == 'x') str = _scanf_getl(str, va_arg(places, int *), 16, width, 0);
    else if ((c == 'e' || c == 'f' || c == 'g') && with_floats) str = _scanf_getf(str, va_arg(places, float *));
    else break;
    if (str) done++;
  }
  return done;
}

int _doscanf(const char *str, const char *format, va_list places) { return scan_text(str, format, places, 1); }
int _intscanf(const char *str, const char *format, va_list places) { return scan_text(str, format, places, 0); }

static int scan_line(text_t *device, const char *format, va_list places, int with_floats) {
  char line[257];
  return scan_text(_safe_gets(device, line, 256), format, places, with_floats);
}

int scan(const char *format, ...) { WITH_VALUES(format, scan_line(terminal_now(), format, values, 1)); }
int scani(const char *format, ...) { WITH_VALUES(format, scan_line(terminal_now(), format, values, 0)); }
int dscan(text_t *device, const char *format, ...) { WITH_VALUES(format, scan_line(device, format, values, 1)); }
int dscani(text_t *device, const char *format, ...) { WITH_VALUES(format, scan_line(device, format, values, 0)); }
int sscan(const char *buffer, const char *format, ...) { WITH_VALUES(format, _doscanf(buffer, format, values)); }
int sscani(const char *buffer, const char *format, ...) { WITH_VALUES(format, _intscanf(buffer, format, values)); }

int sscanAfterStr(char *buffer, char *str, char *format, ...) {
  char *after = strstr(buffer, str);
  if (!after) host_end("crashed", "sscanAfterStr does not find its text, and reads on from address 0");
  WITH_VALUES(format, _doscanf(after + strlen(str), format, values));
}
