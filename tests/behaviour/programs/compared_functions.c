#include <stdio.h>
#define NOBODY nobody
#define JOB work
void nobody();
void work(void *par) { printf("work %d\n", par != 0); }
int add(int a, int b) { return a + b; }
int sub(int a, int b) { return a - b; }

int main(void) {
  if (JOB != NOBODY) work(0);
  if (&work != nobody) printf("b\n");
  if (add == sub) printf("same\n"); else printf("other\n");
  if (add == (void *)0) printf("null\n");
  printf("%d\n", add != sub && add(1, 2) == 3);
  return 0;
}
void nobody(x) int x; { printf("%d", x); }
