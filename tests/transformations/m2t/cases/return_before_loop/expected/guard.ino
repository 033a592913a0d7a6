// guard: guard.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  if (!input(3))
    return;
  while (1) {
    toggle(5);
    pause(50);
  }
  return;
}

void loop() {
}
