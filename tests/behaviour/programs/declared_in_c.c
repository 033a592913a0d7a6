#include <stdio.h>
#include <stdint.h>
_Static_assert(sizeof(int) == 4, "int has 32 bits");
int later[];
int once[];
int sized[];
int first(void) { return later[0] + once[0]; }
_Static_assert(sizeof(char) == 1, "char");
int later[3] = { 40000, 2, 3 };
int sized[4];
static int held[2];
int middle(void) { return held[1]; }
static int held[2] = { 1, 50000 };
counter = 40000;
static three = 3;
int const const twice = 60000;
struct pair { int a; _Static_assert(1, "in a record"); };
add(a, b) { return a + b; }
char *behind(s, n) char *s; int n; { return s + n; }
int total(a, n) int a[]; int n; { int s = 0; while (n--) s += a[n]; return s; }
int corner(a) int a[][2]; { return a[1][1]; }
int low(c) char c; { return c; }
int sum(int n, int a[n]) { int s = 0; for (int i = 0; i < n; i++) s += a[i]; return s; }
int ends(int a[static 3], int n, const int b[const restrict static 2]) { return a[2] + b[n]; }
void copy(int n, char to[restrict], const char from[restrict static 1]) { while (n--) to[n] = from[n]; }
int main(void)
{
  auto int x = 40000;
  auto y = 3;
  const z = 4;
  register r = 6;
  char text[4] = { 0 };
  int list[3] = { 1, 2, 60000 }, grid[2][2] = { { 1, 2 }, { 3, 40000 } };
  struct pair p = { 5 };
  sized[3] = 9;
  copy(3, text, "abc");
  printf("%d %d %d %d\n", first(), later[2], sized[3], middle());
  printf("%d %d %d %d %d\n", x, y, z, r, p.a);
  printf("%d %s %d %d %d\n", add(counter, three), behind("hello", 2), total(list, 3), corner(grid), low(300));
  printf("%d %d %s %d\n", sum(3, list), ends(list, 1, list), text, twice);
  printf("%d %d %d\n", (int)sizeof 'a', (int)sizeof('b'), (int)sizeof(int));
  goto catch;
catch:
  return 0;
}
