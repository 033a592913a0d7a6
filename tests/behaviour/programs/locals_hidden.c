#include "simpletools.h"
int n = 5, i = 6;
void show(void) { printf("%d %d\n", n, i); }
int main()
{
  int n = 70000;
  int i;
  show();
  for (i = 0; i < 2; i++) { int n = i; printf("%d\n", n); }
  while (1)
  {
    static int turns;
    int fresh = 3, list[2] = { 1, 2 };
    n++; fresh++; list[0] += fresh; turns++;
    show();
    printf("%d %d %d %d\n", n, fresh, list[0], turns);
    i += 10;
    pause(10);
  }
}
