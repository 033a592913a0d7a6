#include <stdio.h>
#include <stdlib.h>
#define SIZE 8
#define MASK (SIZE - 1)
typedef struct { volatile unsigned char head, tail;
  int buf[SIZE]; } ring;
ring q;
int put(ring *r, int v) { unsigned char n = (r->head + 1) & MASK;
  if (n == r->tail) return 0;
  r->buf[r->head] = v;
  r->head = n;
  return 1; }
int get(ring *r, int *v) { if (r->head == r->tail) return 0;
  *v = r->buf[r->tail];
  r->tail = (r->tail + 1) & MASK;
  return 1; }
struct node { int key;
  struct node *l, *r; };
struct node *ins(struct node *t, int k) { if (!t) { t = calloc(1, sizeof *t);
    t->key = k; } else if (k < t->key) t->l = ins(t->l, k);
  else t->r = ins(t->r, k);
  return t; }
void walk(const struct node *t) { if (t) { walk(t->l);
    printf("%d ", t->key);
    walk(t->r); } }
int cmp(const void *a, const void *b) { int x = *(const int *)a, y = *(const int *)b;
  return (x > y) - (x < y); }
int cmps(const void *a, const void *b) { return *(int *)b - *(int *)a; }
int main() { int i, v, n = 0;
  for (i = 0; i < 12; i++) n += put(&q, i * 10000);
  printf("%d\n", n);
  while (get(&q, &v)) printf("%d ", v);
  putchar('\n');
  struct node *t = 0;
  int ks[] = { 50000, 3, 70000, -4, 40000 };
  for (i = 0; i < 5; i++) t = ins(t, ks[i]);
  walk(t);
  putchar('\n');
  qsort(ks, 5, sizeof(int), cmp);
  for (i = 0; i < 5; i++) printf("%d ", ks[i]);
  qsort(ks, 5, sizeof *ks, cmps);
  for (i = 0; i < 5; i++) printf("%d ", ks[i]);
  putchar('\n');
  int k = 40000, *f = bsearch(&k, ks, 0, sizeof k, cmp);
  printf("%d\n", f == NULL);
  srand(3);
  v = rand();
  printf("%d\n", v >= 0);
  printf("%d\n", abs(-70000));
  printf("%ld\n", labs(-70000L));
  div_t d = div(100000, 7);
  printf("%d %d\n", d.quot, d.rem);
  return 0; }
