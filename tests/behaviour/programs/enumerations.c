#include <stdio.h>
enum colour { RED, GREEN = 5, BLUE };
enum level { BELOW = -1, ZERO, ABOVE = 40000, TOP = 100000 };
typedef enum { STOP, GO = 70000, LEFT = GO + 5 } command_t;
enum { LIMIT = 1 << 16, MASK = LIMIT - 1 };
static int points[BLUE + 1] = { 1, 2, [GREEN] = 60000, [BLUE] = 7 };
const char *name(enum colour c) { switch (c) { case RED: return "red"; case GREEN: return "green"; case BLUE: return "blue"; } return "?"; }
enum level next(enum level l) { return l + 1; }
typedef enum { SLOW, CRUISE = 300, DONE } mode_t_;
enum tint { DARK, LIGHT = 70000 };
struct driving { mode_t_ m; };
mode_t_ picked(int x) { return x > 3 ? SLOW : CRUISE; }
enum tint inverse(enum tint c) { return c == DARK ? LIGHT : DARK; }
int told(mode_t_ m) { return m * 1000; }
void chosen(int n)
{
  struct driving v = { SLOW };
  mode_t_ list[2] = { CRUISE, DONE };
  v.m = n > 2 ? CRUISE : DONE;
  mode_t_ q = n & 1 ? SLOW : v.m;
  enum tint k = inverse(n % 2 ? DARK : LIGHT);
  list[n & 1] = n > 5 ? list[0] : SLOW;
  printf("%d %d %d %d\n", v.m, q, k, list[n & 1]);
  printf("%d %d %d\n", told(n > 2 ? SLOW : CRUISE), picked(n), (n > 1 ? LIGHT : DARK) * 2);
}
int main()
{
  for (int n = 0; n < 8; n++) chosen(n);
  enum colour c = GREEN;
  enum level l = ABOVE;
  command_t k = LEFT;
  int i;
  c++;
  printf("%d %s\n", c, name(c));
  c = c - 1;
  c |= 2;
  printf("%d\n", c);
  l = l + TOP;
  printf("%d %d %d\n", l, next(BELOW), BELOW - 1);
  k -= 1;
  printf("%d %d\n", k, k == LEFT - 1);
  for (c = RED; c <= BLUE; c++) printf("%d ", points[c]);
  printf("\n%d %d\n", LIMIT, MASK);
  i = GO;
  switch (k) { case STOP: i = 1; break; case GO + 4: i += 2; break; default: i = 3; }
  printf("%d %d\n", i, (int)sizeof(enum level));
  l = BELOW;
  printf("%d %d\n", l < 0, l < ABOVE);
  c = RED;
  printf("%d\n", c - 1 < 0);
  return 0;
}
