/* A lamp that blinks unevenly. */
#include "simpletools.h"

int main() {
  while (1) {
    high(26);
    pause(120);
    low(26);
    pause(380);
  }
}
