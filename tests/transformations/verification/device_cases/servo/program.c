/* A servo that goes to three angles. */
#include "simpletools.h"
#include "servo.h"

int main() {
  servo_angle(16, 0);
  pause(700);
  servo_angle(16, 900);
  pause(700);
  servo_angle(16, 1800);
  pause(700);
  servo_stop();
}
