#include "simpletools.h"
void forever(int n);
void sub(void) { printf("sub\n"); }
int main()
{
  printf("begin\n");
  sub();
  { int i; for (i = 0; i < 3; i++) printf("%d ", i * 40000); }
  printf("\n");
  forever(70000);
  printf("never\n");
  return 0;
}
void forever(int n)
{
  int k = 0;
  while (1) { n += 1000; printf("%d\n", n); if (++k == 5) { while (1); } }
}
