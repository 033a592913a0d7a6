/* A servo at a speed that is limited, and one without feedback. */
#include "simpletools.h"
#include "servo360.h"

#define WHEEL 16
#define SENSE 17

int main() {
  servo360_connect(WHEEL, SENSE);
  servo360_setMaxSpeed(WHEEL, 180);
  servo360_speed(WHEEL, 360);
  pause(1500);
  int a = servo360_getAngle(WHEEL);
  pause(1000);
  print("%d %d\n", servo360_getAngle(WHEEL) - a, servo360_getMaxSpeed(WHEEL));
  servo360_stop(WHEEL);
  pause(700);
  a = servo360_getAngle(WHEEL);
  pause(400);
  print("%d\n", servo360_getAngle(WHEEL) - a);
}
