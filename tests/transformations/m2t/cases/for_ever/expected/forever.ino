// forever: forever.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t n = 3;

void setup() {
}

void loop() {
  n = n + 1; pause(n);
}
