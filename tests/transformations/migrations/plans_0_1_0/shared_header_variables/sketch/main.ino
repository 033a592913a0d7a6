// main: main.c moved from propeller to Arduino Uno.
// Made by RoboSMi 0.1.0. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "state.h"

void setup() {
}

void loop() {
  counter++;
  tick();
}
