// once: once.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  int32_t i;
  for (i = 0; i < 10; i++) {
    high(port(i));
    pause(100);
  }
}

void loop() {
}
