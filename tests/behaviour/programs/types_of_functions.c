#include <stdio.h>
typedef int fn();
typedef int (*pfn)();
typedef void act();
typedef void (*nothing)();
int add(int a, int b) { return a + b; }
int mul(int x, int y) { return x * y; }
int neg(int a) { return -a; }
void show(int a) { printf("show %d\n", a); }
void plain(void) { printf("plain\n"); }
void plain2() { printf("plain2\n"); }
fn *table[2] = { add, mul };
pfn other = neg;
int call(fn *f, int a) { return f(a, 2); }
struct S { pfn p;
  act *r;
  nothing n; } s = { neg, show, plain };
nothing which(int i) { return i ? plain : plain2; }
int main() { pfn t;
  t = &neg;
  printf("%d %d %d\n", table[0](40000, 2), table[1](700, 300), t(1));
  printf("%d %d %d\n", other(3), call(add, 50000), s.p(5));
  s.r(70000);
  s.n();
  which(0)();
  return 0; }
