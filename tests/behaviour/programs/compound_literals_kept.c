#include <stdio.h>
struct p { int x, y; };
struct link { const struct link *up; int v; };
int depth(const struct link *l) { int n = 0; while (l) { n = n * 10 + l->v; l = l->up; } return n; }
int walk(const struct link *up, int n)
{
  if (n == 0) return depth(up);
  return walk(&(struct link){ up, n }, n - 1);
}
int keep(int big)
{
  const struct p *q;
  int *l, i;
  if (big)
    q = &(struct p){ 50000, big };
  else
    q = &(const struct p){ .y = 2, .x = 1 };
  l = (int[]){ 1, big, 0, 0, 70000 };
  for (i = 0; i < 2; i++) { struct p *r = &(struct p){ i, i * 2 }; r->x += 5; printf("%d ", r->x); }
  const char **names = (const char *[]){ "a", "b" };
  switch (big) { case 0: printf("%d ", (&(struct p){ 3, 4 })->y); break; default: printf("d "); }
  printf("%s %d %d ", names[1], (int)sizeof((int[]){ 1, 2, 3 }) / (int)sizeof(int), ((int[]){ 7, 8 })[1]);
  return q->x + q->y + l[1] + l[4] + l[2];
}
static struct { const char *name; int *list; } table[] = { { "t", (int[]){ 40000, 2 } }, { "u", (int[]){ 3 } } };
int main()
{
  int n = 0;
  struct p *state = &(struct p){ 1, 2 }, *second = &(struct p){ n, n + 5 };
  printf("%d\n", walk(NULL, 4));
  printf("%d %d\n", keep(0), keep(1));
  printf("%s %d %d\n", table[0].name, table[0].list[0], table[1].list[0]);
  while (1)
  {
    state->x += 10 + second->y;
    printf("%d\n", state->x);
    if (++n == 3) break;
  }
  return 0;
}
