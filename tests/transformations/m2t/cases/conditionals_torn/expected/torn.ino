// torn: torn.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  high(255 /* P1 is not wired yet */);
#ifndef ONCE
  while (1) {
#else
  {
#endif
    toggle(255 /* P1 is not wired yet */);
  }
}

void loop() {
}
