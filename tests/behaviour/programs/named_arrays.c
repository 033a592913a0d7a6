#include <stdio.h>
typedef int vec3[3];
typedef vec3 mat[2];
typedef unsigned char byte;
typedef unsigned int uint, *uintp;
typedef struct node node;
struct node { int v;
  node *next; };
typedef int (*cmp)(const void *, const void *);
typedef const char *cstr;
typedef enum { LOW_, HIGH_ } level;
typedef float real_t;
typedef int bool_t;
typedef long word;
typedef struct { mat m;
  byte b;
  uintp p; } all;
int sumv(vec3 v) { int s = 0;
  for (int i = 0; i < 3; i++) s += v[i];
  return s; }
int summ(mat m) { return sumv(m[0]) + sumv(m[1]); }
node *push(node *l, node *n) { n->next = l;
  return n; }
int main() { mat m = { { 1, 2, 40000 }, { 4, 5, 6 } };
  uint u = 3000000000u;
  all a = { { { 1, 2, 3 }, { 4, 5, 60000 } }, 255, &u };
  printf("%d %d %u %d\n", summ(m), summ(a.m), *a.p, a.b + 1);
  node n[3];
  node *l = NULL;
  for (int i = 0; i < 3; i++) { n[i].v = i * 30000;
    l = push(l, &n[i]); } int s = 0;
  for (node *q = l; q; q = q->next) s += q->v;
  printf("%d\n", s);
  cstr c = "x";
  level v = HIGH_;
  bool_t t = v == HIGH_;
  word w = 1L << 30;
  printf("%s %d %d %ld\n", c, v, t, w);
  return 0; }
