// nothing: nothing.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  high(1);
  if (input(2)) return;
  low(1);
}

void loop() {
}
