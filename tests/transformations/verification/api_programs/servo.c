#include "simpletools.h"
#include "servo.h"

int main() {
  servo_angle(16, 0);
  pause(1000);
  servo_angle(16, 900);
  pause(1000);
  servo_stop();
}
