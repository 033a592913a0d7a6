#include <stdio.h>
#define LARGE 40000*2
#define HALF(x) (x) / 2
#define SQUARE(x) x * x
#define MAX(a, b) ((a) > (b) ? (a) : (b))
int a = 40000, b = 30000;
unsigned u = 65535;
short s = 30000, t = -30000;
unsigned short us = 65535;
char c = 200;
signed char sc = -100;
unsigned char uc = 250;
long l = 100000;
int list[5] = { 40000, 50000, 60000, -70000, 1 };
unsigned char bytes[4] = { 0x12, 0x80, 0xFF, 0x01 };
int sum(int *p, int n) { int r = 0; while (n--) r += *p++; return r; }
int average(int x, int y) { return (x + y) / 2; }
int from_bytes(unsigned char *p) { return p[0] << 24 | p[1] << 16 | p[2] << 8 | p[3]; }
int main()
{
  printf("%d %d %d\n", LARGE, 40000*2, 1 << 20);
  printf("%d %d %d\n", a + b, a * 2, a * b / 7);
  printf("%d %d %d\n", s + s, s * 3, t - s);
  printf("%d %u\n", u + 1, u * u);
  printf("%d %d\n", us + 1, us * 2);
  printf("%d %d %d %d\n", c + 100, c * c, c - 201, c > sc);
  printf("%d %d\n", sc * 200, uc * uc);
  printf("%d %d\n", ~us, -us);
  printf("%d %d\n", !us, ~uc >> 1);
  printf("%d\n", sum(list, 5));
  printf("%d %x\n", from_bytes(bytes), from_bytes(bytes));
  printf("%d\n", average(2000000000, 10));
  s += 10000;
  t <<= 1;
  us += 3;
  c += 100;
  uc *= 3;
  sc -= 100;
  printf("%d %d %d %d %d %d\n", s, t, us, c, uc, sc);
  s = 40000;
  c = 300;
  printf("%d %d\n", s, c);
  u = 0; u--;
  printf("%u %d\n", u, u > 0);
  printf("%u %u\n", u / 3, u % 1000);
  printf("%d %d\n", -7 / 2, -7 % 3);
  printf("%d %d\n", a > b ? a : -1, s ? 70000 : 1);
  printf("%d\n", MAX(s, 70000));
  printf("%d %d\n", HALF(100001), SQUARE(300));
  printf("%d\n", SQUARE(s) + 1);
  printf("%d %d\n", l == 100000, l * 20000 > 0);
  printf("%d\n", (a, b, 70000));
  printf("%d\n", a & 0xFFFF0000 | 0x10000);
  a |= 0xFFFF0000;
  printf("%d\n", a);
  a = 5; a ^= 0xFF00FF;
  printf("%d %x\n", a, a);
  printf("%d %d\n", (short)70000, (unsigned char)511);
  printf("%d\n", (char)-1);
  printf("%d\n", 'a' * 1000);
  printf("%d %d\n", 0x8000, 0xFFFF + 1);
  printf("%d\n", 100 * 1000 * 3);
  printf("%ld %lu\n", l * 3, 4000000000u + 5ul);
  { int i = 0; int n = list[i++] + list[i++]; printf("%d %d\n", n, i); }
  printf("%d\n", (bytes[1] << 8) + bytes[0] > 0);
  printf("%d\n", (us << 16) == 131072);
  return 0;
}
