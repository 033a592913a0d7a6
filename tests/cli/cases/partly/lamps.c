#include "simpletools.h"

const int lamp = 3;
const int siren = 4;
const int spare = 5;

void never(void) {
  high(spare);
  pause(10);
}

int main() {
  int round = 0;
  while (1) {
    high(lamp);
    pause(100);
    low(lamp);
    pause(100);
    round = (round + 1) % 8;
    if (round > 8) {
      high(siren);
    }
  }
}
