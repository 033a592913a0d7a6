/* lcdParallel.h: commands and characters for the HD44780, in halves on four wires. Sources: liblcdParallel. */
#include "simpletools.h"
#include "lcdParallel.h"

void lcdParallel_write(lcdParallel *device, char value, char bits) {
  set_outputs(device->_data_pins[bits - 1], device->_data_pins[0], value & ((1 << bits) - 1));
  low(device->_enable_pin);
  usleep(1);
  high(device->_enable_pin);
  usleep(1);
  low(device->_enable_pin);
  usleep(100);
}

void lcdParallel_send(lcdParallel *device, char value, char mode) {
  set_output(device->_rs_pin, mode);
  if (device->_displayfunction & LCDP_8BITMODE) {
    lcdParallel_write(device, value, 8);
  } else {
    lcdParallel_write(device, value >> 4, 4);
    lcdParallel_write(device, value, 4);
  }
}

static void command(lcdParallel *device, int value) { lcdParallel_send(device, value, LCDP_SEND_COMMAND); }
void lcdParallel_writeChar(lcdParallel *device, char value) { lcdParallel_send(device, value, LCDP_SEND_WRITE); }

int lcdParallel_print(lcdParallel *device, const char *fmt, ...) {
  char text[128];
  va_list values;
  va_start(values, fmt);
  int length = _dosprnt(fmt, values, text);
  va_end(values);
  for (char *at = text; *at; at++) lcdParallel_writeChar(device, *at);
  return length;
}

void lcdParallel_clear(lcdParallel *device) {
  command(device, LCDP_CLEARDISPLAY);
  pause(2);
}

void lcdParallel_home(lcdParallel *device) {
  command(device, LCDP_RETURNHOME);
  pause(2);
}

static void control(lcdParallel *device, int kept, int set) {
  device->_displaycontrol = (device->_displaycontrol & kept) | set;
  command(device, LCDP_DISPLAYCONTROL | device->_displaycontrol);
}

void lcdParallel_noDisplay(lcdParallel *device) { control(device, ~LCDP_DISPLAYON, 0); }
void lcdParallel_display(lcdParallel *device) { control(device, ~0, LCDP_DISPLAYON); }
void lcdParallel_noCursor(lcdParallel *device) { control(device, ~LCDP_CURSORON, 0); }
void lcdParallel_cursor(lcdParallel *device) { control(device, ~0, LCDP_CURSORON); }
void lcdParallel_noBlink(lcdParallel *device) { control(device, ~LCDP_BLINKON, 0); }
void lcdParallel_blink(lcdParallel *device) { control(device, ~0, LCDP_BLINKON); }

static void mode(lcdParallel *device, int kept, int set) {
  device->_displaymode = (device->_displaymode & kept) | set;
  command(device, LCDP_ENTRYMODESET | device->_displaymode);
}

void lcdParallel_leftToRight(lcdParallel *device) { mode(device, ~0, LCDP_ENTRYLEFT); }
void lcdParallel_rightToLeft(lcdParallel *device) { mode(device, ~LCDP_ENTRYLEFT, 0); }
void lcdParallel_autoscroll(lcdParallel *device) { mode(device, ~0, LCDP_ENTRYSHIFTINCREMENT); }
void lcdParallel_noAutoscroll(lcdParallel *device) { mode(device, ~LCDP_ENTRYSHIFTINCREMENT, 0); }
void lcdParallel_scrollDisplayLeft(lcdParallel *device) { command(device, LCDP_CURSORSHIFT | LCDP_DISPLAYMOVE | LCDP_MOVELEFT); }
void lcdParallel_scrollDisplayRight(lcdParallel *device) { command(device, LCDP_CURSORSHIFT | LCDP_DISPLAYMOVE | LCDP_MOVERIGHT); }

void lcdParallel_setCursor(lcdParallel *device, char col, char row) {
  if (row > 3) row = 3;
  if (row >= device->_numlines) row = device->_numlines - 1;
  command(device, LCDP_SETDDRAMADDR | (col + device->_row_offsets[(int)row]));
}

void lcdParallel_createChar(lcdParallel *device, char loc, char charmap[]) {
  command(device, LCDP_SETCGRAMADDR | (loc & 7) << 3);
  for (int line = 0; line < 8; line++) lcdParallel_writeChar(device, charmap[line]);
}

lcdParallel *lcdParallel_init(char cols, char lines, char dotsize, char rs, char enable, char d0, char d1, char d2, char d3) {
  return lcdParallel_init8(cols, lines, dotsize, rs, enable, d0, d1, d2, d3, 0, 0, 0, 0);
}

lcdParallel *lcdParallel_init8(
  char cols, char lines, char dotsize, char rs, char enable, char d0, char d1, char d2, char d3, char d4, char d5, char d6, char d7
) {
  int whole = d4 != d5 || d5 != d6 || d6 != d7;
  lcdParallel *device = malloc(sizeof *device);
  *device = (lcdParallel){rs, enable, {d0, d1, d2, d3, d4, d5, d6, d7}, 0, 0, 0, lines, {0, 0x40, cols, 0x40 + cols}};
  device->_displayfunction = (whole ? LCDP_8BITMODE : 0) | (lines > 1 ? LCDP_2LINE : 0) | (dotsize == 10 && lines == 1 ? LCDP_5x10DOTS : 0);
  low(rs);
  low(enable);
  for (int bit = 0; bit < (whole ? 8 : 4); bit++) low(device->_data_pins[bit]);
  pause(50);
  int function = LCDP_FUNCTIONSET | device->_displayfunction;
  if (whole) {
    command(device, function);
    usleep(4500);
    command(device, function);
    usleep(150);
    command(device, function);
  } else {
    for (int turn = 0; turn < 3; turn++) {
      lcdParallel_write(device, 3, 4);
      usleep(turn < 2 ? 4500 : 150);
    }
    lcdParallel_write(device, 2, 4);
  }
  command(device, function);
  lcdParallel_display(device);
  lcdParallel_clear(device);
  mode(device, 0, LCDP_ENTRYLEFT);
  return device;
}
