#include "simpletools.h"
int check(int n) { return n > 3; }
int main(void)
{
  int n = 0;
  printf("begin\n");
  if (n > 0) return 1;
  for (;;) {
    n++;
    printf("%d\n", n);
    if (check(n)) { printf("out\n"); return 0; }
    if (n == 100) return 2;
  }
  printf("never\n");
}
