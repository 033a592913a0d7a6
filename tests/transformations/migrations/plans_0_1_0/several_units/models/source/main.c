#include "simpletools.h"
#include "motor.h"

int speed = 24;

int main()
{
  motor_start(MOTOR_PIN);
  while (1) {
    motor_step(speed);
    print("%d\n", steps);
  }
}
