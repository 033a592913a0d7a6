// late: late.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
#define COUNT 4
  int32_t values[COUNT];
  int32_t n = 0;
  while (1) {
    values[n % COUNT] = n;
    pause(values[0]);
  }
}

void loop() {
}
