//# header lcdParallel.h
// Displays of characters with the controller HD44780, on four or eight wires of data. Read from Simple-Libraries 1cc167c10,
// Learn/Simple Libraries/Display/liblcdParallel (lcdParallel.h and its files of one group of functions each).
//# task lcdParallel_init_i2c the library's own body is empty: take the call out, or set up the display's adapter for the I2C bus with a library of it

//# constant LCDP_CLEARDISPLAY
//#   fidelity: exact
#define LCDP_CLEARDISPLAY 0x01

//# constant LCDP_RETURNHOME
//#   fidelity: exact
#define LCDP_RETURNHOME 0x02

//# constant LCDP_ENTRYMODESET
//#   fidelity: exact
#define LCDP_ENTRYMODESET 0x04

//# constant LCDP_DISPLAYCONTROL
//#   fidelity: exact
#define LCDP_DISPLAYCONTROL 0x08

//# constant LCDP_CURSORSHIFT
//#   fidelity: exact
#define LCDP_CURSORSHIFT 0x10

//# constant LCDP_FUNCTIONSET
//#   fidelity: exact
#define LCDP_FUNCTIONSET 0x20

//# constant LCDP_SETCGRAMADDR
//#   fidelity: exact
#define LCDP_SETCGRAMADDR 0x40

//# constant LCDP_SETDDRAMADDR
//#   fidelity: exact
#define LCDP_SETDDRAMADDR 0x80

//# constant LCDP_ENTRYRIGHT
//#   fidelity: exact
#define LCDP_ENTRYRIGHT 0x00

//# constant LCDP_ENTRYLEFT
//#   fidelity: exact
#define LCDP_ENTRYLEFT 0x02

//# constant LCDP_ENTRYSHIFTINCREMENT
//#   fidelity: exact
#define LCDP_ENTRYSHIFTINCREMENT 0x01

//# constant LCDP_ENTRYSHIFTDECREMENT
//#   fidelity: exact
#define LCDP_ENTRYSHIFTDECREMENT 0x00

//# constant LCDP_DISPLAYON
//#   fidelity: exact
#define LCDP_DISPLAYON 0x04

//# constant LCDP_DISPLAYOFF
//#   fidelity: exact
#define LCDP_DISPLAYOFF 0x00

//# constant LCDP_CURSORON
//#   fidelity: exact
#define LCDP_CURSORON 0x02

//# constant LCDP_CURSOROFF
//#   fidelity: exact
#define LCDP_CURSOROFF 0x00

//# constant LCDP_BLINKON
//#   fidelity: exact
#define LCDP_BLINKON 0x01

//# constant LCDP_BLINKOFF
//#   fidelity: exact
#define LCDP_BLINKOFF 0x00

//# constant LCDP_DISPLAYMOVE
//#   fidelity: exact
#define LCDP_DISPLAYMOVE 0x08

//# constant LCDP_CURSORMOVE
//#   fidelity: exact
#define LCDP_CURSORMOVE 0x00

//# constant LCDP_MOVERIGHT
//#   fidelity: exact
#define LCDP_MOVERIGHT 0x04

//# constant LCDP_MOVELEFT
//#   fidelity: exact
#define LCDP_MOVELEFT 0x00

//# constant LCDP_8BITMODE
//#   fidelity: exact
#define LCDP_8BITMODE 0x10

//# constant LCDP_4BITMODE
//#   fidelity: exact
#define LCDP_4BITMODE 0x00

//# constant LCDP_2LINE
//#   fidelity: exact
#define LCDP_2LINE 0x08

//# constant LCDP_1LINE
//#   fidelity: exact
#define LCDP_1LINE 0x00

//# constant LCDP_5x10DOTS
//#   fidelity: exact
#define LCDP_5x10DOTS 0x04

//# constant LCDP_5x8DOTS
//#   fidelity: exact
#define LCDP_5x8DOTS 0x00

//# constant LCDP_SEND_COMMAND
//#   fidelity: exact
#define LCDP_SEND_COMMAND 0x00

//# constant LCDP_SEND_WRITE
//#   fidelity: exact
#define LCDP_SEND_WRITE 0x01

//# type lcdParallel
//#   fidelity: the members of there; the pins are those of the target
struct lcdParallel {
  int32_t _rs_pin, _enable_pin, _data_pins[8];
  uint8_t _displayfunction, _displaycontrol, _displaymode, _numlines, _row_offsets[4];
};

//# type lcdParallel_t
//#   needs: lcdParallel
//#   fidelity: exact
typedef lcdParallel lcdParallel_t;

//# adapter lcdParallel_write
//#   for: void lcdParallel_write(lcdParallel *device, char value, char bits)
//#   kind: oneToMany
//#   needs: lcdParallel hal/Io simpletools.h/low simpletools.h/high
//#   fidelity: the lowest four bits or all eight, the lowest at the first pin; then enable is high for some microseconds, and 100 us pass
//#   limit: there the data pins are the range from the first to the last; here each takes its own bit, so that they may be anywhere
//#   stack: 41 29
inline void lcdParallel_write(lcdParallel *device, uint8_t value, uint8_t bits) {
  for (uint8_t bit = 0; bit < bits; bit++) Io(device->_data_pins[bit]).set(value >> bit & 1);
  low(device->_enable_pin);
  delayMicroseconds(1);
  high(device->_enable_pin);
  delayMicroseconds(1);
  low(device->_enable_pin);
  delayMicroseconds(100);
}

//# adapter lcdParallel_send
//#   for: void lcdParallel_send(lcdParallel *device, char value, char mode)
//#   kind: oneToMany
//#   needs: lcdParallel lcdParallel_write LCDP_8BITMODE hal/Io
//#   fidelity: exact: 0 is a command, 1 a character; on four wires the upper half goes first
//#   stack: 59 53
inline void lcdParallel_send(lcdParallel *device, uint8_t value, uint8_t mode) {
  Io(device->_rs_pin).set(mode & 1);
  bool whole = device->_displayfunction & LCDP_8BITMODE;
  if (!whole) lcdParallel_write(device, value >> 4, 4);
  lcdParallel_write(device, value, whole ? 8 : 4);
}

//# adapter lcdParallel_writeChar
//#   for: void lcdParallel_writeChar(lcdParallel *device, char value)
//#   kind: oneToOne
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_WRITE
//#   fidelity: exact
//#   stack: 58 53
inline void lcdParallel_writeChar(lcdParallel *device, uint8_t value) {
  lcdParallel_send(device, value, LCDP_SEND_WRITE);
}

//# helper LcdStream
//#   needs: lcdParallel lcdParallel_writeChar
//#   ram: 18
struct LcdStream : Stream {  // what is written becomes characters of a display
  lcdParallel *display;
  explicit LcdStream(lcdParallel *shown) : display(shown) {}
  size_t write(uint8_t value) override {
    lcdParallel_writeChar(display, value);
    return 1;
  }
  int available() override { return 0; }
  int read() override { return -1; }
  int peek() override { return -1; }
  void flush() override {}
};

//# adapter lcdParallel_print
//#   for: int lcdParallel_print(lcdParallel *device, const char *fmt, ...)
//#   kind: semantic
//#   needs: lcdParallel LcdStream simpletext.h/text_t simpletext.h/TextOut simpletext.h/TextArgument simpletext.h/format_text
//#   fidelity: exact, in 32 bits; line ends are characters like others. Texts of more than 127 characters, which overflow a buffer there, are shown
//#   stack: 360 340
template <class... Arguments>
inline int32_t lcdParallel_print(lcdParallel *device, const char *fmt, Arguments... given) {
  const TextArgument arguments[] = {TextArgument(), given...};
  LcdStream stream(device);
  text_t text = text_t();
  text.port = &stream;
  return format_text<true>(TextOut(&text), fmt, arguments + 1, sizeof...(given));
}

//# adapter lcdParallel_clear
//#   for: void lcdParallel_clear(lcdParallel *device)
//#   kind: oneToMany
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_CLEARDISPLAY
//#   fidelity: exact, with its 2 ms
//#   stack: 57 53
inline void lcdParallel_clear(lcdParallel *device) {
  lcdParallel_send(device, LCDP_CLEARDISPLAY, LCDP_SEND_COMMAND);
  delay(2);
}

//# adapter lcdParallel_home
//#   for: void lcdParallel_home(lcdParallel *device)
//#   kind: oneToMany
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_RETURNHOME
//#   fidelity: exact, with its 2 ms
//#   stack: 57 53
inline void lcdParallel_home(lcdParallel *device) {
  lcdParallel_send(device, LCDP_RETURNHOME, LCDP_SEND_COMMAND);
  delay(2);
}

//# adapter lcdParallel_noDisplay
//#   for: void lcdParallel_noDisplay(lcdParallel *device)
//#   kind: oneToOne
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_DISPLAYON LCDP_DISPLAYCONTROL
//#   fidelity: exact
//#   stack: 58 53
inline void lcdParallel_noDisplay(lcdParallel *device) {
  device->_displaycontrol &= ~LCDP_DISPLAYON;
  lcdParallel_send(device, LCDP_DISPLAYCONTROL | device->_displaycontrol, LCDP_SEND_COMMAND);
}

//# adapter lcdParallel_display
//#   for: void lcdParallel_display(lcdParallel *device)
//#   kind: oneToOne
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_DISPLAYON LCDP_DISPLAYCONTROL
//#   fidelity: exact
//#   stack: 58 53
inline void lcdParallel_display(lcdParallel *device) {
  device->_displaycontrol |= LCDP_DISPLAYON;
  lcdParallel_send(device, LCDP_DISPLAYCONTROL | device->_displaycontrol, LCDP_SEND_COMMAND);
}

//# adapter lcdParallel_noCursor
//#   for: void lcdParallel_noCursor(lcdParallel *device)
//#   kind: oneToOne
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_CURSORON LCDP_DISPLAYCONTROL
//#   fidelity: exact
//#   stack: 58 53
inline void lcdParallel_noCursor(lcdParallel *device) {
  device->_displaycontrol &= ~LCDP_CURSORON;
  lcdParallel_send(device, LCDP_DISPLAYCONTROL | device->_displaycontrol, LCDP_SEND_COMMAND);
}

//# adapter lcdParallel_cursor
//#   for: void lcdParallel_cursor(lcdParallel *device)
//#   kind: oneToOne
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_CURSORON LCDP_DISPLAYCONTROL
//#   fidelity: exact
//#   stack: 58 53
inline void lcdParallel_cursor(lcdParallel *device) {
  device->_displaycontrol |= LCDP_CURSORON;
  lcdParallel_send(device, LCDP_DISPLAYCONTROL | device->_displaycontrol, LCDP_SEND_COMMAND);
}

//# adapter lcdParallel_noBlink
//#   for: void lcdParallel_noBlink(lcdParallel *device)
//#   kind: oneToOne
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_BLINKON LCDP_DISPLAYCONTROL
//#   fidelity: exact
//#   stack: 58 53
inline void lcdParallel_noBlink(lcdParallel *device) {
  device->_displaycontrol &= ~LCDP_BLINKON;
  lcdParallel_send(device, LCDP_DISPLAYCONTROL | device->_displaycontrol, LCDP_SEND_COMMAND);
}

//# adapter lcdParallel_blink
//#   for: void lcdParallel_blink(lcdParallel *device)
//#   kind: oneToOne
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_BLINKON LCDP_DISPLAYCONTROL
//#   fidelity: exact
//#   stack: 58 53
inline void lcdParallel_blink(lcdParallel *device) {
  device->_displaycontrol |= LCDP_BLINKON;
  lcdParallel_send(device, LCDP_DISPLAYCONTROL | device->_displaycontrol, LCDP_SEND_COMMAND);
}

//# adapter lcdParallel_leftToRight
//#   for: void lcdParallel_leftToRight(lcdParallel *device)
//#   kind: oneToOne
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_ENTRYLEFT LCDP_ENTRYMODESET
//#   fidelity: exact
//#   stack: 58 53
inline void lcdParallel_leftToRight(lcdParallel *device) {
  device->_displaymode |= LCDP_ENTRYLEFT;
  lcdParallel_send(device, LCDP_ENTRYMODESET | device->_displaymode, LCDP_SEND_COMMAND);
}

//# adapter lcdParallel_rightToLeft
//#   for: void lcdParallel_rightToLeft(lcdParallel *device)
//#   kind: oneToOne
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_ENTRYLEFT LCDP_ENTRYMODESET
//#   fidelity: exact
//#   stack: 58 53
inline void lcdParallel_rightToLeft(lcdParallel *device) {
  device->_displaymode &= ~LCDP_ENTRYLEFT;
  lcdParallel_send(device, LCDP_ENTRYMODESET | device->_displaymode, LCDP_SEND_COMMAND);
}

//# adapter lcdParallel_autoscroll
//#   for: void lcdParallel_autoscroll(lcdParallel *device)
//#   kind: oneToOne
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_ENTRYSHIFTINCREMENT LCDP_ENTRYMODESET
//#   fidelity: exact
//#   stack: 58 53
inline void lcdParallel_autoscroll(lcdParallel *device) {
  device->_displaymode |= LCDP_ENTRYSHIFTINCREMENT;
  lcdParallel_send(device, LCDP_ENTRYMODESET | device->_displaymode, LCDP_SEND_COMMAND);
}

//# adapter lcdParallel_noAutoscroll
//#   for: void lcdParallel_noAutoscroll(lcdParallel *device)
//#   kind: oneToOne
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_ENTRYSHIFTINCREMENT LCDP_ENTRYMODESET
//#   fidelity: exact
//#   stack: 58 53
inline void lcdParallel_noAutoscroll(lcdParallel *device) {
  device->_displaymode &= ~LCDP_ENTRYSHIFTINCREMENT;
  lcdParallel_send(device, LCDP_ENTRYMODESET | device->_displaymode, LCDP_SEND_COMMAND);
}

//# adapter lcdParallel_scrollDisplayLeft
//#   for: void lcdParallel_scrollDisplayLeft(lcdParallel *device)
//#   kind: oneToOne
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_CURSORSHIFT LCDP_DISPLAYMOVE LCDP_MOVELEFT
//#   fidelity: exact
//#   stack: 57 53
inline void lcdParallel_scrollDisplayLeft(lcdParallel *device) {
  lcdParallel_send(device, LCDP_CURSORSHIFT | LCDP_DISPLAYMOVE | LCDP_MOVELEFT, LCDP_SEND_COMMAND);
}

//# adapter lcdParallel_scrollDisplayRight
//#   for: void lcdParallel_scrollDisplayRight(lcdParallel *device)
//#   kind: oneToOne
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_CURSORSHIFT LCDP_DISPLAYMOVE LCDP_MOVERIGHT
//#   fidelity: exact
//#   stack: 57 53
inline void lcdParallel_scrollDisplayRight(lcdParallel *device) {
  lcdParallel_send(device, LCDP_CURSORSHIFT | LCDP_DISPLAYMOVE | LCDP_MOVERIGHT, LCDP_SEND_COMMAND);
}

//# adapter lcdParallel_setCursor
//#   for: void lcdParallel_setCursor(lcdParallel *device, char col, char row)
//#   kind: oneToOne
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_SETDDRAMADDR
//#   fidelity: exact: a row that is not there is the last one
//#   stack: 58 53
inline void lcdParallel_setCursor(lcdParallel *device, uint8_t col, uint8_t row) {
  if (row >= 4) row = 3;
  if (row >= device->_numlines) row = device->_numlines - 1;
  lcdParallel_send(device, LCDP_SETDDRAMADDR | (uint8_t)(col + device->_row_offsets[row & 3]), LCDP_SEND_COMMAND);
}

//# adapter lcdParallel_createChar
//#   for: void lcdParallel_createChar(lcdParallel *device, char loc, char charmap[])
//#   kind: oneToMany
//#   needs: lcdParallel lcdParallel_send LCDP_SEND_COMMAND LCDP_SETCGRAMADDR LCDP_SEND_WRITE
//#   fidelity: exact: eight lines of five points, one of eight characters
//#   stack: 67 59
inline void lcdParallel_createChar(lcdParallel *device, uint8_t loc, const void *charmap) {
  const uint8_t *lines = (const uint8_t *)charmap;
  lcdParallel_send(device, LCDP_SETCGRAMADDR | (loc & 7) << 3, LCDP_SEND_COMMAND);
  for (uint8_t line = 0; line < 8; line++) lcdParallel_send(device, lines[line], LCDP_SEND_WRITE);
}

//# adapter lcdParallel_init8
//#   for: lcdParallel *lcdParallel_init8(char cols, char lines, char dotsize, char rs, char enable, char d0, char d1, char d2, char d3, char d4, char d5, char d6, char d7)
//#   kind: oneToMany
//#   needs: lcdParallel lcdParallel_write lcdParallel_send lcdParallel_display lcdParallel_clear LCDP_8BITMODE LCDP_5x10DOTS LCDP_2LINE LCDP_FUNCTIONSET
//#   needs: LCDP_ENTRYLEFT LCDP_ENTRYMODESET LCDP_SEND_COMMAND simpletools.h/low
//#   pin: rs digital out
//#   pin: enable digital out
//#   pin: d0 digital out
//#   pin: d1 digital out
//#   pin: d2 digital out
//#   pin: d3 digital out
//#   pin: d4 digital out
//#   pin: d5 digital out
//#   pin: d6 digital out
//#   pin: d7 digital out
//#   fidelity: exact, with its times: four wires where the upper four pins are one and the same; the memory is never given back, as there
//#   stack: 142 68
inline lcdParallel *lcdParallel_init8(
  uint8_t cols, uint8_t lines, uint8_t dotsize, int32_t rs, int32_t enable, int32_t d0, int32_t d1, int32_t d2, int32_t d3,
  int32_t d4, int32_t d5, int32_t d6, int32_t d7
) {
  bool whole = d4 != d5 || d5 != d6 || d6 != d7;
  uint8_t function = (whole ? LCDP_8BITMODE : 0) | (lines > 1 ? LCDP_2LINE : 0) | (dotsize == 10 && lines == 1 ? LCDP_5x10DOTS : 0);
  lcdParallel *device = new lcdParallel{
    rs, enable, {d0, d1, d2, d3, d4, d5, d6, d7}, function, 0, 0, lines, {0, 0x40, cols, (uint8_t)(0x40 + cols)}};
  low(rs);
  low(enable);
  for (uint8_t bit = 0; bit < (whole ? 8 : 4); bit++) low(device->_data_pins[bit]);
  delay(50);
  const uint16_t waits[3] = {4500, (uint16_t)(whole ? 150 : 4500), (uint16_t)(whole ? 0 : 150)};
  for (uint8_t turn = 0; turn < 3; turn++) {
    if (whole) lcdParallel_send(device, LCDP_FUNCTIONSET | function, LCDP_SEND_COMMAND);
    else lcdParallel_write(device, 3, 4);
    delayMicroseconds(waits[turn]);
  }
  if (!whole) lcdParallel_write(device, 2, 4);
  lcdParallel_send(device, LCDP_FUNCTIONSET | function, LCDP_SEND_COMMAND);
  lcdParallel_display(device);
  lcdParallel_clear(device);
  device->_displaymode = LCDP_ENTRYLEFT;
  lcdParallel_send(device, LCDP_ENTRYMODESET | LCDP_ENTRYLEFT, LCDP_SEND_COMMAND);
  return device;
}

//# adapter lcdParallel_init
//#   for: lcdParallel *lcdParallel_init(char cols, char lines, char dotsize, char rs, char enable, char d0, char d1, char d2, char d3)
//#   kind: oneToOne
//#   needs: lcdParallel lcdParallel_init8
//#   pin: rs digital out
//#   pin: enable digital out
//#   pin: d0 digital out
//#   pin: d1 digital out
//#   pin: d2 digital out
//#   pin: d3 digital out
//#   fidelity: exact, with its times: four wires
//#   stack: 109 70
inline lcdParallel *lcdParallel_init(
  uint8_t cols, uint8_t lines, uint8_t dotsize, int32_t rs, int32_t enable, int32_t d0, int32_t d1, int32_t d2, int32_t d3
) {
  return lcdParallel_init8(cols, lines, dotsize, rs, enable, d0, d1, d2, d3, 255, 255, 255, 255);
}
