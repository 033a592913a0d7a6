// 60 to 130
#include "simpletools.h"
int turn;
int main() {
  while (1) {
    toggle(26);
    turn++;
    if (turn % 3 == 0) pause(100);
    else if (turn % 3 == 1) pause(50);
    else pause(30 + 20 + 10 - 30);
    pause(30);
  }
}
