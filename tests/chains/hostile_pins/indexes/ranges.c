#include "simpletools.h"
int pins[] = { [0 ... 1] = 3, 4, [5 ... 6] = 7 };
int last[4] = { [3] = 8, [0] = 9, 10 };
int main(void) {
  high(pins[0]);
  high(pins[1]);
  high(pins[2]);
  high(pins[6]);
  high(last[1]);
  high(last[3]);
  while (1) pause(1);
}
