// robot: robot.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "lamp.h"
#include "dance_c.h"

void setup() {
}

void loop() {
  dance();
  blink(4);
}
