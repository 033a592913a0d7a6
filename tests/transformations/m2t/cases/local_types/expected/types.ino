// types: types.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  struct point { int32_t x; int32_t y; };
  struct point p = {1, 2};
  while (1) {
    p.x += p.y;
    pause(p.x);
  }
}

void loop() {
}
