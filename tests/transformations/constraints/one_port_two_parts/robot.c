#include "simpletools.h"
#include "abdrive.h"

const int LAMP = 13;

int main(void) {
  while (1) {
    freqout(LAMP, 1, 38000);
    drive_speed(32, 32);
    pause(20);
  }
}
