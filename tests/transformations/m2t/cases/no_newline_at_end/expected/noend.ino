// noend: noend.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t n;
void setup() {
  n = 1;
}

void loop() {
  pause(n);
}
