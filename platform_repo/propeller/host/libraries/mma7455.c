/* mma7455.h: commands of 8 bits, the first of which says whether a byte is written, on one line both ways. Sources: libmma7455. */
#include "mma7455.h"

enum { WRITE = 0x40, SETTINGS = 0x61 };
static int data, clock_pin, enable;

static void command(int bits) {
  low(enable);
  shift_out(data, clock_pin, MSBFIRST, 7, bits);
  shift_out(data, clock_pin, MSBFIRST, 1, 0);
}

void MMA7455_init(int pinData, int pinClock, int pinEnable) {
  data = pinData, clock_pin = pinClock, enable = pinEnable;
  high(enable);
  low(clock_pin);
  MMA7455_writeByte(MMA7455_MCTL, SETTINGS);
}

unsigned char MMA7455_readByte(unsigned char address) {
  command(address & (WRITE - 1));
  unsigned char value = shift_in(data, clock_pin, MSBPRE, 8);
  high(enable);
  return value;
}

void MMA7455_writeByte(unsigned char address, unsigned char value) {
  command(address | WRITE);
  shift_out(data, clock_pin, MSBFIRST, 8, value);
  high(enable);
}

static void change(int kept, int set) { MMA7455_writeByte(MMA7455_MCTL, (MMA7455_readByte(MMA7455_MCTL) & kept) | set); }

void MMA7455_gRange(unsigned char range) { change(0xF3, range << 1 & 0x0C); }

void MMA7455_setMode(unsigned char mode) { change(0xFC, mode); }

unsigned char MMA7455_getMode() { return MMA7455_readByte(MMA7455_MCTL) & 3; }

static short ten_bits(int low_byte) {
  int value = MMA7455_readByte(low_byte);
  value |= MMA7455_readByte(low_byte + 1) << 8;
  return value & 0x200 ? value | 0xFC00 : value;
}

void MMA7455_getxyz10(signed short *x, signed short *y, signed short *z) {
  *x = ten_bits(MMA7455_XOUTL);
  *y = ten_bits(MMA7455_YOUTL);
  *z = ten_bits(MMA7455_ZOUTL);
}

void MMA7455_getxyz8(signed char *x, signed char *y, signed char *z) {
  *x = MMA7455_readByte(MMA7455_XOUT8);
  *y = MMA7455_readByte(MMA7455_YOUT8);
  *z = MMA7455_readByte(MMA7455_ZOUT8);
}

static void offset_at(int low_byte, int value) {
  MMA7455_writeByte(low_byte, value);
  MMA7455_writeByte(low_byte + 1, value >> 8);
}

void MMA7455_setOffsetX(signed short offset) { offset_at(MMA7455_XOFFL, offset); }

void MMA7455_setOffsetY(signed short offset) { offset_at(MMA7455_YOFFL, offset); }

void MMA7455_setOffsetZ(signed short offset) { offset_at(MMA7455_ZOFFL, offset); }
