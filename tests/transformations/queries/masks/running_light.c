// ports 0 1 2 3
#include "simpletools.h"
int main(void) {
  DIRA = 0xF;
  while (1)
    for (unsigned m = 1; m <= 8; m <<= 1) { OUTA = m; pause(50); }
}
