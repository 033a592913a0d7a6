#include "simpletools.h"
static int a = 5;
int *pa = &a;
int (*fp)(const char *, ...) = 0;
int lut[] = { ['a'] = 1, ['z'] = 40000 };
char grid[2][3] = { { '#', '.', '#' }, { [1] = '@' } };
struct cfg { int pins[3];
  const char *label;
  float k; } cfg = { { 1, 2, 3 }, "cfg", .5f }, *pc = &cfg, arr[2] = { [1] = { .label = "one", .pins = { [2] = 70000 } } };
int main(void) { int i = 0;
  int total = 0;
  const int step = 20000;
  static int visits = 0;
  float f = 0;
  char name[8] = "abc";
  int *walk = lut;
  while (1) { int local = step * i;
    total += local;
    f += 0.25;
    visits++;
    if (i % 2) { i++;
      continue; } walk = &lut['z'];
    printf("%d %d %.2f %d\n", i, total, f, *walk + visits);
    name[0]++;
    if (i >= 4) break;
    i++; } printf("%s %c %d %s %d %.1f\n", name, grid[1][1], *pa, arr[1].label, arr[1].pins[2], pc->k);
  printf("%d\n", (int)(sizeof lut / sizeof *lut));
  return 0; }
