// 62 to 69
#include "simpletools.h"
#define BLINK(n) do { toggle(n); pause(50); } while (0)
#define NEVER 0
int main() {
  while (1) {
    BLINK(26);
    do { pause(7); if (input(3)) break; pause(7); } while (NEVER);
    while (0) { pause(900); }
    pause(5);
  }
}
