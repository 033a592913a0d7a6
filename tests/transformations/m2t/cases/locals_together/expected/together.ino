// together: together.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t a = 1, b = 2, *p;

void setup() {
  p = &a;
}

void loop() {
  a = a + b;
  *p = 3;
  pause(a);
}
