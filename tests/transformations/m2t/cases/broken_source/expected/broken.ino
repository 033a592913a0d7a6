// broken: broken.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t n = 0
  while (1) {
    high(255 /* P1 is not wired yet */);

void setup() {
}

void loop() {
  high(1);
  pause(n);
}
