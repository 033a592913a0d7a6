#include "simpletools.h"   // the library

int count = 9;                     // a global that a local hides

int next(void) { return ++count; }

int main()                         // starts here
{
  int x, y, z;                     // three of one type
  const int first = next(), second = 2;  /* one of them constant */
  const char *text = "go", *const other = text;
  register int fast = 3;
  static int kept;
  int count = 1;                   // not the global
  int left = count + 1;
  void (*act)(int) = high;
  int HIGH = 4;
  for (;;) {
    x = first + second + left;
    y = x + count + next() + HIGH;
    z = y + fast + kept++;
    act(z);
    print("%s %s %d\n", text, other, z);
  }
}
