// robot: wheels.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "wheels.h"

void forward(int32_t speed) {
  drive_speed(speed, speed);
  print("speed %d\n", speed);
}
