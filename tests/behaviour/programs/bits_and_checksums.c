#include <stdio.h>
#include <stdint.h>
#include <stdbool.h>
#define SET(r, b) ((r) |= 1 << (b))
#define CLR(r, b) ((r) &= ~(1 << (b)))
#define GET(r, b) (((r) >> (b)) & 1)
#define FIELD(r, hi, lo) (((r) >> (lo)) & ((1 << ((hi) - (lo) + 1)) - 1))
uint32_t reg;
uint8_t bytes[4];
int16_t s16;
bool flag;
static inline bool odd(int v) { return v & 1; }
uint8_t crc8(const uint8_t *p, int n) { uint8_t c = 0;
  while (n--) { c ^= *p++;
    for (int i = 0; i < 8; i++) c = c & 0x80 ? c << 1 ^ 0x07 : c << 1; } return c; }
uint16_t crc16(const char *p) { uint16_t c = 0xFFFF;
  while (*p) { c ^= *p++ << 8;
    for (int i = 0; i < 8; i++) c = c & 0x8000 ? (c << 1) ^ 0x1021 : c << 1; } return c; }
int parity(unsigned v) { int p = 0;
  while (v) { p = !p;
    v &= v - 1; } return p; }
unsigned gray(unsigned v) { return v ^ v >> 1; }
int rev8(int v) { int r = 0;
  for (int i = 0; i < 8; i++) r = r << 1 | (v >> i & 1);
  return r; }
int main() { SET(reg, 20);
  SET(reg, 31);
  CLR(reg, 31);
  printf("%x %d %d\n", reg, GET(reg, 20), FIELD(0xABCDEF, 19, 8));
  for (int i = 0; i < 4; i++) bytes[i] = reg >> (8 * i);
  printf("%d %d\n", bytes[2], bytes[3]);
  s16 = bytes[2] << 8 | 0x80;
  printf("%d\n", s16);
  s16 = 0xFF << 8 | 0x80;
  printf("%d\n", s16);
  flag = 256;
  printf("%d %d %d\n", flag, odd(3), !odd(70001));
  printf("%x %x\n", crc8((uint8_t *)"123456789", 9), crc16("123456789"));
  printf("%d %u %d\n", parity(0x80000001), gray(100000), rev8(0x35));
  int temp = (0xF3 << 8 | 0x10) >> 4;
  printf("%d\n", temp);
  int8_t t8 = 0xF3;
  printf("%d\n", t8 * 256 + 0x10);
  printf("%d\n", (int16_t)(0xF3 << 8 | 0x10) / 16);
  unsigned char hi = 0x12, lo = 0x34;
  unsigned short w = hi << 8 | lo;
  int neg = (short)(0xFE << 8 | lo);
  printf("%d %d\n", w, neg);
  printf("%d\n", ~hi & 0xff);
  printf("%d\n", -lo);
  printf("%d\n", hi - lo < 0);
  printf("%d\n", (hi << 24) < 0 ? 1 : 0);
  return 0; }
