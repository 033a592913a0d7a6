#include "simpletools.h"
#include "servo.h"

void turn(int by) {
  servo_speed(6, by);
  print("turned %d\n", by);
  pause(100);
  high(3);
}
