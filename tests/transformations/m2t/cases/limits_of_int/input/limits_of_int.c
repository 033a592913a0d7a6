#include "simpletools.h"

int limits[] = {32767, 32768, -32768, -32769, 2147483647};
unsigned tops[] = {65535, 65536};

int main() {
  while (1) {
    high(limits[0]);
    low(tops[0]);
  }
}
