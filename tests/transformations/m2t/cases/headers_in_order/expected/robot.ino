// robot: robot.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "moves.h"

void setup() {
  while (near(20) == 0) pause(50);
  away(100);
  drive_speed(0, 0);
}

void loop() {
}
