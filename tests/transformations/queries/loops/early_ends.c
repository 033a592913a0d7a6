// 20 to 120
#include "simpletools.h"
int turn;
int main() {
  while (1) {
    toggle(26);
    pause(20);
    if (turn++ % 2) continue;
    for (int i = 0; i < 10; i++) {
      if (i == 4) break;
      pause(10);
    }
  }
}
