// dowhile: dowhile.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  int32_t n = 0;
  do {
    n++;
    pause(n);
  } while (1);
}

void loop() {
}
