#include <stdio.h>
#include "moods.h"
struct { int (*go)(); int n; } unnamed = { 0, 70000 };
static int angry(int c) { return c * 2; }
int sad(int c) { return -c; }
void run(int a, int b) { printf("run %d %d\n", a, b); }
void fall(int a, int b) { printf("fall %d %d\n", a, b); }
int none(void) { return 5; }
struct mood moods[2] = { { angry, run }, { sad, fall } };
int (*table[2])() = { angry, sad };
void (*other)(), (*handed)();
char *name_of(int a) { return a > 40000 ? "more" : "less"; }
const char *(*named)() = name_of;
void each_of(void (*what)(int, int)) { what(1, 2); }
int main() {
  struct mood m = moods[0], *at = &moods[1];
  int i;
  begin();
  for (i = 0; i < 2; i++) moods[i].active(100000, i);
  (*m.active)(1, 2);
  at->active(3, 4);
  printf("%d %d %d\n", m.passive(30000), at->passive(3), table[1](40000));
  printf("%d %d\n", table[0](5, 6), (*table[1])(7, i));
  unnamed.go = none;
  printf("%d %d\n", unnamed.go(1), unnamed.go() + unnamed.n);
  each(run);
  each(i > 5 ? run : fall);
  other = run;
  handed = i ? other : 0;
  each_of(handed);
  handed(1, 2);
  shared("told", 50000);
  printf("%s %s %d\n", named(50000), named(3), sensors[1].read(200));
  return 0;
}
