#include <stdio.h>
typedef struct { char a:3; char b:5, c:4; } bf_t;
typedef char letter;
struct other { letter d:3; signed char e:3; unsigned char f:3; int g:3; } o;
bf_t b;
int main(void) {
  b.a = 7; b.b = 31; b.c = 15; o.d = 6; o.e = 7; o.f = 7; o.g = 7;
  printf("%d %d %d %d %d %d %d\n", b.a, b.b, b.c, o.d, o.e, o.f, o.g);
  int sum = b.a + b.b; b.a++; printf("%d %d %d\n", sum, b.a > 3, b.c == 15);
  return 0;
}
