// leave: leave.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t state(void) { return input(255 /* P4 is not wired yet */); }

void setup() {
  if (input(255 /* P3 is not wired yet */) == 0) return;
  high(255 /* P5 is not wired yet */);
  if (input(255 /* P6 is not wired yet */)) {
    low(255 /* P5 is not wired yet */);
    return (void)(state());
  }
  return;
}

void loop() {
}
