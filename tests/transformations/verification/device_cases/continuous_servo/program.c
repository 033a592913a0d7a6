/* A servo that turns all round: one way, not at all, the other way. */
#include "simpletools.h"
#include "servo.h"

int main() {
  servo_speed(16, 100);
  pause(800);
  servo_speed(16, 0);
  pause(800);
  servo_speed(16, -100);
  pause(800);
}
