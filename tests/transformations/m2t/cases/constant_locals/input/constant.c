#include "simpletools.h"

int main()
{
  const int base = 5;
  int next = base + 1;
  int room = sizeof(next);
  while (1) {
    next += room;
    pause(next);
  }
}
