// arguments: arguments.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  int argc = 0;
  if (argc > 1) pause(argc);
  high(255 /* P2 is not wired yet */);
  return;
}

void loop() {
}
