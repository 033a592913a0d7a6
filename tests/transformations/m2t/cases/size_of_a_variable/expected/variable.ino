// variable: variable.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  int32_t n = 5;
  int32_t values[n];
  while (1) {
    values[0] = n;
    pause(values[0]);
  }
}

void loop() {
}
