// robot: robot.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "wheels.h"

void setup() {
  drive_setRampStep(4);
}

void loop() {
  forward(64);
  pause(1000);
  drive_speed(0, 0);
  print("stands\n");
}
