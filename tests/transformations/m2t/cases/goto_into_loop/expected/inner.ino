// inner: inner.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  high(255 /* P1 is not wired yet */);
}

void loop() {
  int32_t tries = 0;
  retry:
  tries++;
  if (tries < 3) goto retry;
  pause(tries);
}
