// ports ? 3
#include "simpletools.h"
int main() {
  int mask = 1;
  high(3);
  while (1) {
    DIRA |= mask;
    mask <<= 1;
  }
}
