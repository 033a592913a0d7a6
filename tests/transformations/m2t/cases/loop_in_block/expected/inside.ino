// inside: inside.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  int32_t n = 0;
  if (input(255 /* P1 is not wired yet */)) {
    while (1) { n++; }
  }
  {
    while (1) { pause(n); }
  }
}

void loop() {
}
