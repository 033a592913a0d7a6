/* Speeds that come slowly, and a stop when a whisker touches. */
#include "simpletools.h"
#include "abdrive.h"

int main() {
  drive_setRampStep(10);
  drive_ramp(64, 32);
  while (input(7) == 1)
    ;
  drive_speed(0, 0);
  print("stop\n");
  pause(200);
  drive_speed(-64, -64);
  pause(400);
  drive_speed(0, 0);
}
