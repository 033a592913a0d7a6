// first: first.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

static int state = 1;
static int next(void) { return state++; }
int other(void);

void setup() {
}

void loop() {
  pause(next() + other());
}
