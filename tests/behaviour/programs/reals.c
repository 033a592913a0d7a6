#include <stdio.h>
#include <math.h>
float f = 1.5f; double d = 100000.0; int i = 7, big = 100000; short s = 3; unsigned char b = 200;
float half(int v) { return v / 2.0; }
int rounded(float v) { return (int)(v + 0.5f); }
int main()
{
  printf("%d %d\n", (int)(f * 3), (int)d);
  printf("%d\n", rounded(half(70001)));
  printf("%d %d\n", (int)(i / 2 * 2.0), (int)(i / 2.0 * 2));
  printf("%d\n", (int)(big * 0.5));
  printf("%d\n", (int)sqrt(250000.0 * 4));
  printf("%d\n", (int)(sin(0.5) * 1000));
  f = big; f /= 3; printf("%d\n", (int)f);
  i = 3.99; printf("%d\n", i);
  i = -3.99; printf("%d\n", i);
  i += 2.7; printf("%d\n", i);
  i *= 1000.5; printf("%d\n", i);
  b = 100.9; printf("%d\n", b);
  printf("%.2f %.1f\n", 0.1 + 0.2, f);
  printf("%d\n", f > 33333 && f < 33334);
  printf("%d\n", (int)(pow(2, 15) + 0.5));
  printf("%d\n", (int)fabs(-70000.0));
  printf("%d\n", (int)(s * b * 1.0f));
  printf("%d\n", (int)floor(-2.5));
  return 0;
}
