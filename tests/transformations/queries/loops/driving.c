// 50 to 170
#include "simpletools.h"
#include "abdrive.h"
int turn;
int main() {
  while (1) {
    toggle(26);
    turn++;
    drive_speed(turn % 3 * 10, 20);
    pause(50);
  }
}
