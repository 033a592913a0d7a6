#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <limits.h>
int main()
{
  char c = 200; short s = -5; unsigned short us = 65000; long l = -100000; unsigned u = 3000000000u; unsigned char b = 255;
  int i = 123456;
  char buffer[40];
  int x, y; long z; short w; char word[10]; unsigned q;
  printf("%d %d %d %ld %u %d\n", c, s, us, l, u, b);
  printf("%i %x %X %o\n", i, i, i, i);
  printf("[%8d] [%-8d] [%08d] [%+d]\n", i, i, i, i);
  printf("[%*d]\n", 8, i);
  printf("%c%c %%\n", 'o', 'k');
  printf("%hd %hu\n", s, us);
  printf("%d %s %d\n", 1, "two", 3);
  printf("%s\n", i > 100 ? "large" : "small");
  printf("%d\n", sizeof(int));
  printf("%d %d\n", INT_MAX, INT_MIN);
  printf("%u\n", UINT_MAX);
  printf("%d\n", (int)strlen("abc"));
  x = sprintf(buffer, "%d-%d", 100000, -100000);
  printf("%s %d\n", buffer, x);
  snprintf(buffer, 5, "%d", 1234567);
  printf("%s\n", buffer);
  printf("%d %d\n", atoi("70000"), atoi("-123456"));
  printf("%d %ld\n", abs(-70000), labs(-70000));
  x = sscanf("70000 -5 abc", "%d %d %s", &x, &y, word) + x * 0;
  printf("%d %d %s\n", x, y, word);
  sscanf("100000 7 99", "%ld %hd %u", &z, &w, &q);
  printf("%ld %d %u\n", z, w, q);
  sscanf("ff 10", "%x %i", &x, &y);
  printf("%d %d\n", x, y);
  printf("%d %d\n", (int)strtol("80000", NULL, 10), (int)strtol("1FFFF", 0, 16));
  { div_t d = div(100000, 7); printf("%d %d\n", d.quot, d.rem); }
  printf("%5.2f %.3f %f\n", 3.14159, 2.5f, 1.0);
  { const char *format = "n=%d\n"; printf(format, 90000); }
  printf("%d " "%d\n", 70000, 80000);
  printf("%c", 'a'); printf("\n");
  { int list[3] = { 100000, 2, 3 }; int k; for (k = 0; k < 3; k++) printf("%d%s", list[k], k < 2 ? ", " : "\n"); }
  puts("end of it");
  return 0;
}
