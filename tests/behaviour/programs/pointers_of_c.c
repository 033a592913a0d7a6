#include <stdio.h>
#include <stdint.h>
int more(int a) { return a + 40000; }
int seven(void) { return 7; }
int call(void *p) { int (*q)(void) = p; return q(); }
int (*pick(int i))(int) { return more; }
typedef int op(int);
int run(op *f) { return f(1); }
int run_too(int f(int)) { return f(2); }
void *table[2] = { more, (void *)more };
char *name(int known) { return known ? "known" : "none"; }
int main(void)
{
  void *p = more, *v;
  int (*q)(int) = p;
  char *given = NULL, *shown = given ?: "nothing", *from = &"hello"[1];
  void *bytes = "abc";
  unsigned char *u = "abc";
  uint8_t *b;
  int list[2] = { 40000, 2 };
  unsigned *un = list;
  long *l = list;
  v = &seven;
  v = seven;
  bytes++;
  b = u;
  from = "world" + 2;
  printf("%d %d %d\n", q(1), ((int (*)(int))table[0])(2), ((int (*)(int))table[1])(3));
  printf("%d %d %d %d %d\n", call(seven), call(v), pick(0)(5), run(more), run_too(&more));
  printf("%s %s %s %s\n", shown, from, (char *)bytes, name(0));
  printf("%c%c %u %ld\n", u[0], b[1], un[0], l[1]);
  return 0;
}
