#include "board.h"
#include "motor.h"
int main()
{
  motor_speed(1, 2)
  set_output(0, 1;
  STOP();
}
