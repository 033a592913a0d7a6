// stop: stop.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void after_loop();
void end_of_main();

void setup() {
}

void loop() {
  if (input(255 /* P2 is not wired yet */)) return after_loop();
  toggle(255 /* P3 is not wired yet */);
}

void after_loop() {
  low(255 /* P3 is not wired yet */);
  return end_of_main();
}

// main has ended: nothing is repeated any more
void end_of_main() {
  for (;;) yield();
}
