#include "simpletools.h"
#include "motor.h"

int steps;
static int pin;

void motor_start(int p)
{
  pin = p;
  low(pin);
}

void motor_step(int n)
{
  steps += n > speed ? speed : n;
  pulse_out(pin, steps);
}
