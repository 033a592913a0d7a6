// local: local.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

// Functions that are used before they are defined
int32_t speed(int32_t n);

void setup() {
  int32_t speed(int32_t n);
  pause(speed(1));
}

void loop() {
  pause(speed(2));
}

int32_t speed(int32_t n) { return n * 2; }
