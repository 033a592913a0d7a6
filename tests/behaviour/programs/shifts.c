#include <stdio.h>
unsigned char b = 0x81;
char c = 0x81;
short s = -2;
int n = 17, one = 1;
unsigned mask(int bit) { return 1 << bit; }
int main()
{
  int i, r = 0;
  printf("%d %d %d\n", b << 8, b << 16, b << n);
  printf("%d %d\n", c << 8, c >> 1);
  printf("%d %d\n", s << 4, s >> 1);
  printf("%d %d\n", 1 << n, one << 20);
  printf("%u %d\n", mask(31), mask(16) == 65536);
  for (i = 0; i < 32; i += 5) r |= 1 << i;
  printf("%d %x\n", r, r);
  r >>= 3; printf("%d\n", r);
  r = 1; r <<= 18; printf("%d\n", r);
  b <<= 1; printf("%d\n", b);
  b = 0xF0; b >>= 4; printf("%d\n", b);
  s = 0x7000; s <<= 1; printf("%d\n", s);
  s = -32768; s >>= 3; printf("%d\n", s);
  { unsigned short w = 0xC000; int k = w << 1; w <<= 1; printf("%d %d\n", k, w); }
  printf("%d\n", (unsigned)-1 >> 28);
  printf("%d\n", -1 >> 28);
  printf("%d\n", ~0 << 16);
  printf("%d\n", (~0u >> 1) == 0x7FFFFFFF);
  { unsigned long v = 0x80000000; printf("%lu %d\n", v >> 31, (int)(v >> 24)); }
  { char hi = 0xAB, lo = 0xCD; int w = hi << 8 | lo; printf("%d %x\n", w, w); }
  { signed char hi = 0xAB; unsigned char lo = 0xCD; int w = (hi << 8) | lo; printf("%d\n", w); }
  for (i = 0, r = 0x80000; r; r >>= 1) i++;
  printf("%d\n", i);
  return 0;
}
