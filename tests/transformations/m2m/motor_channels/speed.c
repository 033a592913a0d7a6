#include "simpletools.h"
#include "servo.h"

int main()
{
  servo_speed(12, 100);
  pause(500);
  servo_speed(12, -200);
  pause(500);
  servo_disable(12);
  servo_angle(14, 900);
}
