#include "simpletools.h"
#define START 3
int main() {
  while (1) {
    if (input(START)) dac_ctr(26, 0, 100);
    pause(10);
  }
}
