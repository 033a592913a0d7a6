#include <stdio.h>
const int N = 5;
const int table[] = { 1, 70000 };
static const char *const msg = "m";
int arr2[3];
const volatile int cv = 7;
void take(char *s) { printf("%s\n", s); }
void takev(int *p) { printf("%d\n", *p); }
const char *give(void) { return "give"; }
char *lit = "literal";
char *mut(const char *s) { return s; }
void usev(volatile int *p) { ++*p; }
int main() { int local[N];
  for (int i = 0; i < N; i++) local[i] = i * 30000;
  printf("%d\n", local[N - 1]);
  take("text");
  take(give());
  takev(table + 1);
  char *p = give();
  printf("%s %s %s\n", p, mut("q"), lit);
  volatile int v = 69999;
  usev(&v);
  takev(&v);
  int *q = &v;
  printf("%d\n", *q);
  const int *cp = table;
  int *wp = cp;
  printf("%d\n", wp[1]);
  switch (3) { case 3: printf("three\n"); } void *vp = local;
  int *ip = vp;
  printf("%d\n", ip[2]);
  unsigned *up = local;
  printf("%u\n", up[1]);
  float f = cv;
  int **pp = &q;
  const int **cpp = pp;
  printf("%d\n", **cpp);
  long *lp = &N;
  printf("%ld\n", *lp);
  int addr = &v != 0;
  printf("%d %.1f\n", addr, f);
  char *cs[] = { "a", "b" };
  const char **ccs = cs;
  printf("%s\n", ccs[1]);
  return 0; }
