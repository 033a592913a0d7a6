#include <stdio.h>
int left, left, right;
int a, b; int *p, c, (*f)(int), a;
int c, q = 3, *p;
int early, beside = 4;
int z1, z2;
static int u, v;
static int u, v = 7;
int twice(int x) { return 2 * x + z1; }
int z1 = 5;
int z2 = 6, z3;
int early = 9;
typedef int Colour; enum Colour { RED_ONE = 1, BLUE_ONE };
typedef struct item { int n; } item;
typedef struct { volatile item *item; const int n; } holder;
enum Colour favourite = BLUE_ONE;
Colour other = 70000;
int main(void) {
  item it = {4}; holder h = {&it, 2};
  f = twice; p = &c; c = 8; a = 1; b = 2; left = 3; right = 4;
  printf("%d %d %d %d %d\n", left, right, a, b, c);
  printf("%d %d %d %d %d %d %d %d\n", f(4), *p, q, early, beside, z1, z2, z3);
  printf("%d %d %d %d %d %d\n", u, v, favourite, other, h.item->n, h.n);
  return 0;
}
