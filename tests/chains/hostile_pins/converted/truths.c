#include "simpletools.h"
#include <stdbool.h>

_Bool first = 7;
static int same(bool given) { return given; }
static _Bool returned(void) { return 9; }

int main(void) {
  bool local = 4;
  high(first);
  high(local + 2);
  high((bool)8 + 4);
  high(same(6));
  high(returned());
  while (1) pause(100);
}
