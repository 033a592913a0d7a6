#include <stdio.h>
struct p { int x, y; };
int sum(const struct p *a) { return a->x + a->y; }
int total(int *list, int n) { int i, t = 0; for (i = 0; i < n; i++) t += list[i]; return t; }
struct p byval(struct p a) { a.x *= 100; return a; }
struct p *kept = &(struct p){7, 50000};
int *numbers = (int[]){1, 2, 70000};
int main()
{
  printf("%d\n", sum(&(struct p){300, 400}));
  printf("%d\n", sum(&(struct p){.y = 40000, .x = 3}));
  printf("%d\n", total((int[]){1, 20000, 30000}, 3));
  printf("%d\n", byval((struct p){700, 1}).x);
  printf("%d\n", ((struct p){5, 6}).y);
  struct p *q = &(struct p){ .x = 11 };
  int *l = (int[]){4, 5};
  q->y = 60000; l[1] = 9;
  printf("%d %d %d %d\n", q->x, q->y, l[0], l[1]);
  printf("%d %d %d\n", kept->x, kept->y, numbers[2]);
  struct p a;
  a = (struct p){1, 2};
  printf("%d %d\n", a.x, a.y);
  char *name = (char[]){'a', 'b', 0};
  name[0] = 'z';
  printf("%s\n", name);
  return 0;
}
