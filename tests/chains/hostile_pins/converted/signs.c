#include "simpletools.h"

int main(void) {
  unsigned four = 4;
  high(2 + (-1 < 0u) + 1);
  high(2 + (-1 > 0) + 4);
  high((-3 < four) + 13);
  high(-8 / 2 + 20);
  while (1) pause(100);
}
