#include "simpletools.h"
typedef struct { int n; short s; } pair;
static int calls;
int next(void) { return ++calls; }
int main()
{
  int x, y, z;
  int a = 1, b = next(), *p = &a;
  int list[3] = { 70000, 2 };
  int other[] = { 1, 2, 40000 };
  char text[] = "abc", *s = text;
  const int limit = 40000;
  const char *words[] = { "one", "two" };
  pair q = { 5, -3 }, *r = &q;
  static int kept = 9;
  volatile int v = 3;
  unsigned char m[2][2] = { { 1, 2 }, { 3, 250 } };
  int HIGH = 7, random = 8, A0 = 9, F = 10, byte = 11, min = 12;
  float f = 0.5;
  int (*get)(void) = next;
  int n = 3;
  int dynamic[n];
  register int i;
  long total = 0L;
  x = 10; y = 20; z = b;
  for (i = 0; i < n; i++) dynamic[i] = i * 30000;
  while (1)
  {
    x += limit; y--; z++;
    list[2] += x;
    total += list[2];
    *p += 2;
    other[1] += HIGH + random + A0 + F + byte + min;
    r->n += r->s;
    kept++; v += 2;
    f += 0.25;
    m[1][1] += 3;
    text[0] = 'a' + (x & 7);
    printf("%d %d %d %d %d %d ", x, y, z, a, b, list[2]);
    printf("%d %d %s %s ", other[1], other[2], s, words[y & 1]);
    printf("%d %d %d %d %d %d %ld %d\n", q.n, kept, v, m[1][1], (int)(f * 4), dynamic[2], total, get());
    pause(20);
  }
}
