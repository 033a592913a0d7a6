#include <stdio.h>
struct flags { unsigned ready : 1; unsigned mode : 3; int trim : 5; unsigned wide : 20; int big : 24; };
struct packed { unsigned char a : 4, b : 4; unsigned short w : 12; signed char s : 3; };
union word { int i; unsigned u; short s[2]; unsigned char b[4]; struct { unsigned lo : 16; unsigned hi : 16; } halves; };
struct flags f = { 1, 5, -7, 0xABCDE, -70000 };
int main(void)
{
  struct packed p = { 9, 12, 4000, -3 };
  union word w;
  printf("%d %d %d %d %d\n", f.ready, f.mode, f.trim, f.wide, f.big);
  f.mode += 6;
  f.trim -= 12;
  f.wide += 0x60000;
  f.big = f.big * 2;
  printf("%d %d %d %d\n", f.mode, f.trim, f.wide, f.big);
  p.a += p.b;
  p.w <<= 2;
  p.s--;
  printf("%d %d %d %d\n", p.a, p.b, p.w, p.s);
  printf("%d %d\n", f.mode - 7, (f.wide << 4) > 0);
  printf("%u\n", f.wide * 5000);
  w.i = -2;
  printf("%u %d %d %d %d %x\n", w.u, w.s[0], w.s[1], w.b[0], w.halves.hi, w.halves.lo);
  w.b[3] = 0x12;
  printf("%d %x\n", w.i, w.u);
  w.halves.hi = 0x7FFF;
  printf("%d\n", w.i);
  f.ready = 2;
  printf("%d %d\n", f.ready, ~f.mode);
  return 0;
}
