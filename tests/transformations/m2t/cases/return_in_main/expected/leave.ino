// leave: leave.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t state(void) { return input(4); }

void setup() {
  if (input(3) == 0) return;
  high(5);
  if (input(6)) {
    low(5);
    return (void)(state());
  }
  return;
}

void loop() {
}
