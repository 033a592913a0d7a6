#include "simpletools.h"
#include "servo.h"

int main(void) {
  servo_speed(12, 100);
  servo_angle(14, 900);
  pause(2000);
  servo_speed(12, 0);
}
