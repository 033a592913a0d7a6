// cases: cases.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t n = 0;

void setup() {
}

void loop() {
  switch (n) {
    case 0:
      n = 1;
      int32_t twice; twice = 2 * n;
      pause(twice);
      break;
    default:
      n = 0;
  }
}
