// together: together.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  int a = 1, b = 2, *p = &a;
  while (1) {
    a = a + b;
    *p = 3;
    pause(a);
  }
}

void loop() {
}
