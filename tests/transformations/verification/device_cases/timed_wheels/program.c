/* Wheels that are driven for a time, which ramps make longer. */
#include "simpletools.h"
#include "abdrive.h"

int main() {
  drive_setRampStep(12);
  drive_ramp(100, 90);
  pause(700);
  drive_ramp(0, 0);
  pause(500);
  drive_speed(64, -64);
  pause(290);
  drive_speed(0, 0);
}
