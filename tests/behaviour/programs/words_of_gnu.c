#include <stdio.h>
static inline int sq(int a) { return a * a; }
inline static unsigned hi(unsigned v) { return v >> 16; }
static int cu(int a) { return a * a * a; }
static __inline__ int tw(int a) { return 2 * a; }
int dot(const int *restrict a, const int *__restrict__ b, int n) { int s = 0;
  for (int i = 0; i < n; i++) s += a[i] * b[i];
  return s; }
static int always(int) __attribute__((always_inline));
static inline int always(int v) { return v + 40000; }
int __attribute__((noinline)) noin(int a) { return a - 1; }
void __attribute__((unused)) un(void) {}
int main() { int a[] = { 300, 400 }, b[] = { 500, 600 };
  register int r = 5;
  auto int w = 70000;
  volatile int v = 3;
  printf("%d %u %d %d %d %d %d\n", sq(300), hi(0x12345678), tw(40000), dot(a, b, 2), always(1), noin(70000), r + w + v);
  return 0; }
