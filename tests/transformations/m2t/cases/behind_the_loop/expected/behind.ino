// behind: behind.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
}

void loop() {
  toggle(255 /* P1 is not wired yet */);
}
// never reached
/* nor this */
