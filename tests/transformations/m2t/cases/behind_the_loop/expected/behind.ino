// behind: behind.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
}

void loop() {
  toggle(1);
}
// never reached
/* nor this */
