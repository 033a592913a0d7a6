// toggle: toggle.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  int32_t mask = 0x3fffffff;
  DIRA = mask;
}

void loop() {
  OUTA ^= DIRA;
  waitcnt(CNT + CLKFREQ / 2);
}
