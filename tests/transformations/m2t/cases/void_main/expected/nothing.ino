// nothing: nothing.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  high(255 /* P1 is not wired yet */);
  if (input(255 /* P2 is not wired yet */)) return;
  low(255 /* P1 is not wired yet */);
}

void loop() {
}
