// bymacro: bymacro.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#define STEP(n) total += (n)

int32_t total = 0;

void setup() {
}

void loop() {
  STEP(2);
  pause(10);
}
