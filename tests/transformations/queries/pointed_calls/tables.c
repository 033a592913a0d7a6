#include "simpletools.h"
#include <string.h>

typedef int (*act)(int);
struct step { const char *name; act run; int (*alt[2])(int); };
struct machine { void (*state)(struct machine *); int left; };

int big(int n) { char buffer[500]; memset(buffer, n, sizeof buffer); return buffer[n] + n; }
int small(int n) { return n + 1; }
int other(int n) { return n + 2; }
int two(int a, int b) { return a + b; }
void idle(struct machine *m) { m->left--; }
void work(struct machine *m) { m->state = idle; }

int (*const table[])(int) = { small, &big };
struct step steps[] = { { "a", small, { other } }, { .name = "b", .run = small } };
act chosen;
int (*nobody)(char *, char *);
int pick;

int call(act f, int n) { return f(n); }  // reaches: small
act choose(int n) { return n ? other : small; }

int main(void)
{
  struct machine m = { work };
  m.state(&m);  // reaches: idle work
  print("%d\n", table[pick++](3));  // reaches: big small
  print("%d\n", steps[0].run(4));  // reaches: small
  print("%d\n", steps[0].alt[0](4));  // reaches: other
  print("%d\n", call(small, 2) + two(1, 2));
  chosen = choose(pick);
  print("%d\n", chosen(5));  // reaches: other small
  act *walked = (act *)memchr(table, 1, 2);
  print("%d\n", (*walked)(6));  // reaches: big idle other small work
  if (pick > 9) print("%d\n", nobody("a", "b"));  // reaches:
  return 0;
}
