// zero: zero.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

const int32_t table[4] = {};
static const int32_t zero = 0;

void setup() {
}

void loop() {
  pause(table[1] + zero);
}
