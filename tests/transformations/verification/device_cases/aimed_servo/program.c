/* A servo that turns to an angle, for a time, and to an angle again. */
#include "simpletools.h"
#include "servo360.h"

int main() {
  servo360_connect(16, 14);
  servo360_speed(16, 180);
  pause(700);
  servo360_speed(16, 0);
  pause(600);
  servo360_angle(16, 70);
}
