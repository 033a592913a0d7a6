#include <stdio.h>
#define NEXT(i) ((i)++)
#define TWICE(x) (x) + (x)
#define STR(x) #x
#define XSTR(x) STR(x)
#define CAT(a, b) a##b
#define LIMIT 40000
#define SHOW(x) printf(#x " = %d\n", (int)(x))
#define ADD(a, b) ({ int _a = (a), _b = (b); _a + _b; })
#define LOOP(n) for (i = 0; i < n; i++)
#define DECLARE(name) int name##_value = 60000
#define CHECK(c) do { if (!(c)) printf("failed: %s\n", #c); } while (0)
#define DEFAULTED(...) total(__VA_ARGS__, 0)
#define BIG (LIMIT * 2)
#define TYPE int
#define FOREVER while (1)
int total(int a, int b, int c) { return a + b + c; }
DECLARE(speed);
TYPE get(TYPE v) { return v * 2; }
#define VERSION 12
int CAT(my, var) = 5;
int main()
{
  int i = 3, n;
  n = NEXT(i) + NEXT(i); printf("%d %d\n", n, i);
  printf("%d\n", TWICE(30000) * 2);
  printf("%s %s\n", STR(LIMIT), XSTR(VERSION));
  SHOW(i + 1); SHOW(LIMIT * 2); SHOW((short)70000);
  printf("%d\n", ADD(30000, 30000));
  LOOP(3) n += LIMIT;
  printf("%d\n", n);
  CHECK(i == 4); CHECK(LIMIT > BIG);
  printf("%d\n", DEFAULTED(40000, 50000));
  printf("%d %d %d\n", BIG, speed_value * 2, get(70000));
  printf("%d\n", myvar);
  n = 0; FOREVER { if (n++ > 3) break; } printf("%d\n", n);
#if LIMIT > 30000 && defined(BIG)
  printf("large\n");
#else
  printf("small\n");
#endif
#if 40000 * 2 == 80000
  printf("wide\n");
#endif
  printf("line %d\n", __LINE__ > 0);
  return 0;
}
