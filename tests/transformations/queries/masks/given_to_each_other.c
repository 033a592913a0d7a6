// ports 4 9
#include "simpletools.h"
int main(void) {
  unsigned one, other, third;
  one = 1 << 4;
  while (1) {
    other = one | other;
    third = other;
    one = third;
    third = 1 << 9;
    OUTA = third;
    pause(100);
  }
}
