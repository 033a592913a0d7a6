#include "simpletools.h"
#include "abdrive.h"

#define FRONT input(7)      // infrared at the front
const int lamp = 26;

int main() {
  while (1) {
    if (FRONT) {
      high(lamp);
      drive_speed(0, 0);
    } else {
      low(lamp);
      drive_speed(64, 64);
    }
    pause(50);
  }
}
