/* A servo that tells its angle is turned to angles and goes on by some. */
#include "simpletools.h"
#include "servo360.h"

int main() {
  print("%d\n", servo360_connect(12, 14));
  servo360_angle(12, 180);
  pause(1200);
  print("%d\n", servo360_getAngle(12));
  servo360_angle(12, -90);
  pause(1800);
  print("%d\n", servo360_getAngle(12));
  servo360_goto(12, 360);
  pause(2500);
  print("%d\n", servo360_getAngle(12));
}
