// robot: robot.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "config.h"
#include "wheel.h"

struct wheel w;

void setup() {
  w = {WHEEL_PIN, 0};
  start(&w);
}

void loop() {
  turn(&w);
  pause(PERIOD);
}
