#include "simpletools.h"
#include "parts.h"
static int count = 5;
static int helper(int n) { return n + count; }
extern int shared;
extern int list[];
extern const char *names[2];
int common;
int undeclared_later();
int main()
{
  int i;
  printf("%d %d\n", helper(70000), first(2));
  printf("%d %d\n", second(3), shared);
  shared *= 2; show();
  for (i = 0; i < 3; i++) printf("%d ", list[i]);
  printf("%s %s\n", names[0], names[1]);
  common = 70000; show();
  printf("%d\n", undeclared_later(2));
  printf("%d %d\n", box.left, twice(40000));
  return 0;
}
