// short: short.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  high(255 /* P3 is not wired yet */);
}

void loop() {
  toggle(255 /* P3 is not wired yet */); pause(10);
}
