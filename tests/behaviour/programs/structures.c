#include <stdio.h>
#include <string.h>
#include <stddef.h>
typedef struct point { int x, y; } point;
struct node { int value; struct node *next; };
struct robot { char name[8]; point at; struct { short left, right; } speed; point path[3]; union { int whole; unsigned char part[4]; } code; };
struct robot make(int n) { struct robot r; memset(&r, 0, sizeof r); strcpy(r.name, "bot"); r.at.x = n; r.at.y = -n; r.path[2].x = n * 2; r.code.whole = n; return r; }
point add(point a, point b) { point c = { a.x + b.x, a.y + b.y }; return c; }
void twice(point *p) { p->x *= 2; (*p).y += p->y; }
int total(struct node *n) { return n ? n->value + total(n->next) : 0; }
struct node c = { 60000, NULL }, b = { 50000, &c }, a = { .value = 40000, .next = &b };
static const struct { const char *name; int value; int (*f)(struct node *); } table[] = { { "one", 100000, total }, { "two", 2, NULL } };
point grid[2][3] = { { { 1, 2 }, { 3, 4 } }, { { 50000, 60000 } } };
int main()
{
  struct robot r = make(35000), s;
  point p = { 20000, 30000 }, *q = &p;
  s = r;
  r.at = add(r.at, p);
  twice(&s.at);
  twice(q);
  printf("%d %d %d %d\n", r.at.x, r.at.y, s.at.x, s.at.y);
  printf("%d %d %s %d\n", p.x, q->y, s.name, s.path[2].x);
  printf("%d\n", total(&a));
  printf("%s %d %d\n", table[0].name, table[0].value, table[0].f(&b));
  printf("%d %d %d\n", grid[1][0].x + grid[1][0].y, (int)(sizeof grid / sizeof grid[0]), (int)(sizeof(grid) / sizeof(point)));
  printf("%d %d\n", s.code.part[0], s.code.part[1]);
  s.speed.left = 30000; s.speed.left += 10000;
  printf("%d\n", s.speed.left);
  printf("%d\n", memcmp(&r.path, &s.path, sizeof r.path));
  { point list[] = { { 1, 2 }, { 70000, 4 } }, *e; int sum = 0; for (e = list; e < list + sizeof list / sizeof *list; ++e) sum += e->x; printf("%d\n", sum); }
  { point z = (point){ 5, 70000 }; printf("%d\n", z.y); }
  printf("%d\n", (int)(&grid[1][1] - &grid[0][0]));
  printf("%d %d\n", (int)sizeof(point), (int)offsetof(point, y));
  return 0;
}
