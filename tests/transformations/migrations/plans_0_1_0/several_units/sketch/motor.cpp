// main: motor.c moved from propeller to Arduino Uno.
// Made by RoboSMi 0.1.0. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

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
