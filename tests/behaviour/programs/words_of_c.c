#include <stdio.h>
#include <stdlib.h>
void copy(int *restrict to, const int *restrict from, int n) { while (n--) *to++ = *from++; }
void copy_twice(int *restrict, const int *, int);
_Noreturn void stop(int value) { printf("stop %d\n", value); while (1); }
_Alignas(4) char aligned[4] = "abc";
int main()
{
  _Static_assert(sizeof(char) == 1, "char");
  int from[3] = { 1, 2, 70000 }, to[3];
  int *restrict p = to;
  copy(to, from, 3);
  copy_twice(to, from, 3);
  printf("%d %d %s\n", p[2], (int)_Alignof(char), aligned);
  return 0;
}
void copy_twice(int *restrict to, const int *from, int n) { copy(to, from, n); to[0] = 5; printf("%d\n", to[0]); }
