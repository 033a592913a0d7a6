// A main whose loop is left: by a break, by a return with a call, by a return before it.
#include "simpletools.h"

int main()
{
  int turns = 0, most = input(1), unused;
  if (input(4)) return 1;
  while (1) {
    if (++turns > most) break;
    if (input(5)) return input(6);
    pause(10);
  }
  high(26);
  return 0;
}
