// own: own.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup_(void) { high(255 /* P1 is not wired yet */); }
void loop_(void) { toggle(255 /* P1 is not wired yet */); }
void init_(int32_t n) { pause(n); }

void setup() {
  setup_();
  init_(3);
}

void loop() {
  loop_();
}
