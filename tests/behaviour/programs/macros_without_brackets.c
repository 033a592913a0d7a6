#include <stdio.h>
#define SCALE(v, k) v * k
#define DIST(t) t * 34 / 200
#define SQUARE(x) x * x
#define TOTAL(a, b) a + b
#define OTHER(a) ~a
#define SHIFTED(a, n) a << n
#define TURNED(a) -a
#define MIXED(a, b) a * b + b
#define BOTH SHORT + 5
#define SHORT width
#define FARTHER(a) SCALE(a, 3)
#define SIZE(x) x < 0 ? -x : x
int main()
{
  unsigned char duty = 200, c = 250;
  short t = 5000, width = 30000;
  int n = 4, d = 90;
  printf("%d %d\n", SCALE(duty, duty), SCALE(n + 50, 2));
  printf("%d %d\n", DIST(t), DIST(t + 10));
  printf("%d %d\n", SQUARE(t), SQUARE(n + 1));
  printf("%d %d\n", TOTAL(t, t) * 7, TOTAL(t * 7, t ? 1 : 3));
  printf("%d %d\n", OTHER(c), OTHER(c + 1));
  printf("%d %d %d\n", SHIFTED(c, 8), SHIFTED(1 + 2, 4), SHIFTED(n | 1, 4));
  printf("%d %d\n", TURNED(c), TURNED(n - 1));
  printf("%d %d\n", MIXED(c, c), MIXED(n + 1, n + 2));
  printf("%d %d\n", BOTH * 3, SCALE(BOTH, 2));
  printf("%d %d\n", FARTHER(width), FARTHER(n + 1));
  printf("%d %d\n", SIZE(t), SIZE(d - 100));
  return 0;
}
