#include <stdio.h>
#define BASE 10
#define CLK 80000000
#define PIN(n) (BASE + (n))
#define US(t) ((t) * (CLK / 1000000))
#define MASK (1 << 20)
#define NEXT PIN(2) + 1
#define SIZE sizeof(int)
#define U 3u * BASE
#if PIN(3) > 12 && US(1000) == 80000
int a = PIN(4000) * 10;
#elif MASK
int a = 2;
#endif
#if NEXT == 13 && U > 5
int b = US(2000);
#endif
int main() { short s = 300;
  char c = 200;
  printf("%d %d %d\n", a, b, PIN(s) * 200);
  printf("%d %u %d\n", US(s), U * 70000, NEXT);
  printf("%d %d\n", PIN(c), MASK);
  return 0; }
