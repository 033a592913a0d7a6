#include <stdio.h>
struct R { unsigned en : 1;
  unsigned mode : 3;
  int off : 5;
  unsigned : 0;
  unsigned long cnt : 20;
  signed char t : 4;
  _Bool f : 1; };
struct W { int a : 12;
  int b : 20;
  unsigned c : 32; } ;
struct R regs[2] = { { 1, 5, -3, 700000, -2, 1 }, { .cnt = 1048575, .off = 15 } };
int main() { struct R r = regs[0];
  r.cnt += 400000;
  r.off -= 14;
  r.mode += 4;
  printf("%u %u %d %lu %d %d\n", r.en, r.mode, r.off, (unsigned long)r.cnt, r.t, r.f);
  printf("%d %d\n", r.mode << 20, r.cnt * 5 > 2000000);
  struct W w = { -2000, 500000, 4000000000u };
  w.b++;
  printf("%d %d %u %d\n", w.a, w.b, w.c, w.b * 3);
  printf("%d\n", regs[1].off + 1 > 15);
  printf("%d\n", (regs[1].en - 1) < 0);
  printf("%d\n", regs[1].cnt + 1 == 1048576);
  return 0; }
