// std: std.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>
#include <stdbool.h>
#include <stdint.h>

#include "adapters.h"

bool on = false;
uint8_t count;

void setup() {
}

void loop() {
  on = !on;
  count++;
  pause(count);
}
