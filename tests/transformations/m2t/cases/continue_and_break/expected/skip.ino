// skip: skip.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t mode;

void setup() {
  high(255 /* P1 is not wired yet */);
}

void loop() {
  int32_t i;
  if (input(255 /* P2 is not wired yet */)) return;
  for (i = 0; i < 4; i++) {
    if (i == 2) continue;
    if (i == 3) break;
    toggle(port(i));
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
