// single: single.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t ticks;

void setup() {
  ticks = 1;
}

void loop() {
  toggle(255 /* P26 is not wired yet */);
}
