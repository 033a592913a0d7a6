// guard: guard.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void end_of_main();

void setup() {
  if (!input(255 /* P3 is not wired yet */))
    return end_of_main();
}

void loop() {
  toggle(255 /* P5 is not wired yet */);
  pause(50);
}

// main has ended: nothing is repeated any more
void end_of_main() {
  for (;;) yield();
}
