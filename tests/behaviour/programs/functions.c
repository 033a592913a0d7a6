#include <stdio.h>
#include <stdarg.h>
int apply(int (*f)(int, int), int a, int b) { return f(a, b); }
int mul(int a, int b) { return a * b; }
int sub(int a, int b) { return a - b; }
int (*ops[])(int, int) = { mul, sub };
typedef void (*action)(int);
int seen;
void note(int v) { seen += v; }
void again(action a, int n) { while (n--) a(n * 1000); }
int sum(int n, ...) { va_list v; int r = 0; va_start(v, n); while (n-- > 0) r += va_arg(v, int); va_end(v); return r; }
long longs(int n, ...) { va_list v; long r = 0; va_start(v, n); while (n--) r += va_arg(v, long); va_end(v); return r; }
int mixed(const char *kinds, ...) {
  va_list v; int r = 0; va_start(v, kinds);
  for (; *kinds; kinds++) switch (*kinds) {
    case 'i': r += va_arg(v, int); break;
    case 'c': r += va_arg(v, int) * 2; break;
    case 'd': r += (int)va_arg(v, double); break;
    case 's': { char *s = va_arg(v, char *); while (*s) r += *s++; break; }
    case 'u': r += va_arg(v, unsigned) % 1000; break;
  }
  va_end(v); return r;
}
int vsay(char *out, const char *format, ...) { va_list v; int n; va_start(v, format); n = vsprintf(out, format, v); va_end(v); return n; }
int counter(void) { static int n = 65530; static char c; c += 100; return n++ + c; }
int factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }
old(a, b, c) int a; short b; char *c; { return a + b + *c; }
static inline int clamp(int v, int lo, int hi) { if (v < lo) return lo; return v > hi ? hi : v; }
void swap(int *a, int *b) { int t = *a; *a = *b; *b = t; }
short narrow(int v) { return v; }
char byte_of(int v) { return v; }
unsigned char low(int v) { return v & 0xFF; }
int fill(int n, int list[n]) { int i, s = 0; for (i = 0; i < n; i++) { list[i] = i * 30000; s += list[i]; } return s; }
int main(int argc, char *argv[])
{
  int x = 70000, y = -5, list[4];
  short s = 12; char c = 200; char out[30];
  printf("%d %d\n", apply(mul, 300, 300), apply(sub, -40000, 40000));
  printf("%d %d\n", ops[0](1000, 1000), (*ops[1])(1, 70000));
  again(note, 60); printf("%d\n", seen);
  printf("%d %d\n", sum(3, 40000, s, c), sum(2, 1, 'a'));
  printf("%ld\n", longs(2, 100000L, -5L));
  printf("%d\n", mixed("icdsu", 70000, c, 2.5, "ab", 70000u));
  printf("%d ", vsay(out, "%d:%d", 70000, s)); printf("%s\n", out);
  counter(); counter(); printf("%d\n", counter());
  printf("%d\n", factorial(12));
  printf("%d\n", old(70000, s, "A"));
  printf("%d %d\n", clamp(x, 0, 65000), clamp(y, -2, 2));
  swap(&x, &y); printf("%d %d\n", x, y);
  printf("%d %d %d\n", narrow(70000), byte_of(-1), low(511));
  printf("%d\n", fill(4, list));
  printf("%d\n", list[3]);
  return 0;
}
