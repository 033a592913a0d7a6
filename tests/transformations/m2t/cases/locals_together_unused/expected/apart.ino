// apart: apart.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int total;

void setup() {
  int a = 1, b = 2;
  total = a + b;
}

void loop() {
  pause(total);
}
