// robot: robot.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

static int32_t counter = 1;
extern const int32_t limit;

// Functions that are used before they are defined
int32_t twice(int32_t x);
void show();

void setup() {
}

void loop() {
  counter = twice(counter) % limit;
  show();
}
