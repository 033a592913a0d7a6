/* The C library reads what is typed. */
#include <stdio.h>
#include "simpletools.h"

int main() {
  int a, b;
  float f;
  char s[16];
  int n = scanf("%d %f", &a, &f);
  printf("%d %d %.1f\n", n, a, f);
  int c = getchar();
  printf("%c %d\n", c, c);
  n = sscanf("x=123456,abc;0x1F", "x=%3d%d,%[a-c];%i", &a, &b, s, &c);
  printf("%d %d %d %s %d\n", n, a, b, s, c);
  n = sscanf("none", "%d", &a);
  printf("%d\n", n);
}
