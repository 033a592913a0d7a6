// apart: apart.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t total;

void setup() {
  int32_t a = 1, b = 2;
  total = a + b;
}

void loop() {
  pause(total);
}
