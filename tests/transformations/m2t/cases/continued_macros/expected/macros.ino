// macros: macros.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#define PULSE(pin, t) do { \
    high(pin);            \
    pause(t);             \
    low(pin);             \
  } while (0)

void setup() {
#define TWICE(x) \
        PULSE(x, 1); \
        PULSE(x, 2)
  PULSE(255 /* P3 is not wired yet */, 10);
}

void loop() {
  TWICE(255 /* P4 is not wired yet */);
#define LATE 5
  pause(LATE);
}
