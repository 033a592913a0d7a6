/* lcdParallel.h of the Simple Libraries: displays of characters on four or eight wires. */
#ifndef ROBOSMI_LCDPARALLEL_H
#define ROBOSMI_LCDPARALLEL_H
#define LCDP_CLEARDISPLAY 0x01
#define LCDP_RETURNHOME 0x02
#define LCDP_ENTRYMODESET 0x04
#define LCDP_DISPLAYCONTROL 0x08
#define LCDP_CURSORSHIFT 0x10
#define LCDP_FUNCTIONSET 0x20
#define LCDP_SETCGRAMADDR 0x40
#define LCDP_SETDDRAMADDR 0x80
#define LCDP_ENTRYRIGHT 0x00
#define LCDP_ENTRYLEFT 0x02
#define LCDP_ENTRYSHIFTINCREMENT 0x01
#define LCDP_ENTRYSHIFTDECREMENT 0x00
#define LCDP_DISPLAYON 0x04
#define LCDP_DISPLAYOFF 0x00
#define LCDP_CURSORON 0x02
#define LCDP_CURSOROFF 0x00
#define LCDP_BLINKON 0x01
#define LCDP_BLINKOFF 0x00
#define LCDP_DISPLAYMOVE 0x08
#define LCDP_CURSORMOVE 0x00
#define LCDP_MOVERIGHT 0x04
#define LCDP_MOVELEFT 0x00
#define LCDP_8BITMODE 0x10
#define LCDP_4BITMODE 0x00
#define LCDP_2LINE 0x08
#define LCDP_1LINE 0x00
#define LCDP_5x10DOTS 0x04
#define LCDP_5x8DOTS 0x00
#define LCDP_SEND_COMMAND 0x00
#define LCDP_SEND_WRITE 0x01
typedef struct lcdParallel_st {
  int _rs_pin, _enable_pin, _data_pins[8];
  char _displayfunction, _displaycontrol, _displaymode, _numlines, _row_offsets[4];
} lcdParallel_t;
typedef lcdParallel_t lcdParallel;
void lcdParallel_write(lcdParallel *device, char value, char bits);
void lcdParallel_send(lcdParallel *device, char value, char mode);
void lcdParallel_writeChar(lcdParallel *device, char value);
int lcdParallel_print(lcdParallel *device, const char *fmt, ...);
void lcdParallel_clear(lcdParallel *device);
void lcdParallel_home(lcdParallel *device);
void lcdParallel_noDisplay(lcdParallel *device);
void lcdParallel_display(lcdParallel *device);
void lcdParallel_noCursor(lcdParallel *device);
void lcdParallel_cursor(lcdParallel *device);
void lcdParallel_noBlink(lcdParallel *device);
void lcdParallel_blink(lcdParallel *device);
void lcdParallel_leftToRight(lcdParallel *device);
void lcdParallel_rightToLeft(lcdParallel *device);
void lcdParallel_autoscroll(lcdParallel *device);
void lcdParallel_noAutoscroll(lcdParallel *device);
void lcdParallel_scrollDisplayLeft(lcdParallel *device);
void lcdParallel_scrollDisplayRight(lcdParallel *device);
void lcdParallel_setCursor(lcdParallel *device, char col, char row);
void lcdParallel_createChar(lcdParallel *device, char loc, char charmap[]);
lcdParallel *lcdParallel_init8(char cols, char lines, char dotsize, char rs, char enable, char d0, char d1, char d2, char d3, char d4, char d5, char d6, char d7);
lcdParallel *lcdParallel_init(char cols, char lines, char dotsize, char rs, char enable, char d0, char d1, char d2, char d3);
#endif
