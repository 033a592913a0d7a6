#include "simpletools.h"

#define B0(x) high(x)
#define B1(x) B0(x); B0(x + 1)
#define PAIR(x) do { B1(x); low((x) * 2 + 1); } while (0)

int main()
{
  B1(1);
  PAIR(7);
  return 0;
}
