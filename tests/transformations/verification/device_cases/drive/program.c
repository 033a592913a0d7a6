/* Two wheels: ahead, turn, stop. */
#include "simpletools.h"
#include "abdrive.h"

int main() {
  drive_speed(64, 64);
  pause(1500);
  drive_speed(64, -64);
  pause(1500);
  drive_speed(0, 0);
}
