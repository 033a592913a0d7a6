// dos: dos.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#define LED 255 /* P26 is not wired yet */

int32_t n = 0;

// A comment.
void setup() {
  set_direction(LED, 1);
}

void loop() {
  n++;  // count

  pause(n);
}
