#include "simpletools.h"

static char store[16] = "0123456789";
void *begin = store, *end = store + 9;
const void *there = "abc";

int span(void) { return end - begin; }

int main() {
  void *p = begin;
  char *q = p + 2;
  void *r = begin + 3 - 1;
  const char *t = there + 1;
  print("%d %d %d %d\n", span(), (int)(q - (char *)p), (int)(r - p), r + 1 == begin + 3);
  print("%s %s\n", q, t);
  return 0;
}
