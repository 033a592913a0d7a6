// ports 2 5 7
#include "simpletools.h"
const int leds[3] = {2, 5, 7};
int main(void) {
  unsigned all = 0;
  for (int i = 0; i < 3; i++) all |= 1 << leds[i];
  DIRA |= all;
  while (1) { OUTA ^= all; pause(100); }
}
