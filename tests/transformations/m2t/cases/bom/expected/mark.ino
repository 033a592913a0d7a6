// mark: mark.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

// Größe
void setup() {
  high(255 /* P1 is not wired yet */);
}

void loop() {
  low(255 /* P1 is not wired yet */);
}
