#include <stdio.h>
int x = 70000;
int f(int x) { { int x = 3;
    { extern int x;
      printf("%d ", x); } printf("%d ", x); } return x; }
int main() { int i, j, k = (i = 3, j = 40000, i * j);
  printf("%d %d\n", f(9), k);
  for (i = 0, j = 10; i < j; i++, j -= 2) ;
  printf("%d %d\n", i, j);
  int x = x = 5;
  for (int x = 0; x < 2; x++) { int x = 100000;
    printf("%d ", x); } printf("%d\n", x);
  int a[] = { (1, 2), 3 };
  printf("%d %d\n", a[0], (k++, k--, k));
  if (i = 0, j == 4) puts("yes");
  while (i++, i < 5) if (i == 3) continue;
  else putchar('0' + i);
  putchar('\n');
  struct x { int x; } y = { x };
  struct x z = y;
  printf("%d\n", z.x);
  typedef int T;
  { int T = 5;
    printf("%d\n", T * 2); } T q = 66000;
  printf("%d\n", q);
  do { int i = 5;
    i++; } while (i-- > 3, i > 2);
  printf("%d\n", i);
  return (0, 0); }
