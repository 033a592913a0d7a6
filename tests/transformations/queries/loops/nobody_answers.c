// 10 to 260
#include "simpletools.h"
int main() {
  while (1) {
    toggle(26);
    pause(10);
    if (pulse_in(7, 1) == 0) print("-");
  }
}
