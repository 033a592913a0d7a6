#include "servo.h"
#include "wheels.h"

static void both(int left, int right)
{
  servo_speed(12, left);
  servo_speed(13, right);
}

void forward(int speed) { both(speed, -speed); }
void turn(void) { both(10, 10); pause(300); }
