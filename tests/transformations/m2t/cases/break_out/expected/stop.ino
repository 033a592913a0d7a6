// stop: stop.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  while (1) {
    if (input(2)) break;
    toggle(3);
  }
  low(3);
  return;
}

void loop() {
}
