#include "simpletools.h"
#define FRONT input(7)
#define BUTTON 3
#define PRESSED (input(BUTTON) == 1)
#define BLINK(n) do { high(n); pause(50); low(n); } while (0)

int main() {
  while (1) {
    while (FRONT);
    if (PRESSED || FRONT) BLINK(26);
    pause(5);
  }
}
