// main: motor.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "motor.h"

int32_t steps;
static int32_t pin;

void motor_start(int32_t p)
{
  pin = p;
  low(port(pin));
}

void motor_step(int32_t n)
{
  steps += n > speed ? speed : n;
  pulse_out(port(pin), steps);
}
