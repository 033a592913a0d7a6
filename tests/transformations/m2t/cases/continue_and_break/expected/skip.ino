// skip: skip.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t mode;

void setup() {
  high(1);
}

void loop() {
  int32_t i;
  if (input(2)) return;
  for (i = 0; i < 4; i++) {
    if (i == 2) continue;
    if (i == 3) break;
    toggle(i);
  }
  switch (mode) {
    case 0:
      mode = 1;
      break;
    default:
      return;
  }
  pause(20);
}
