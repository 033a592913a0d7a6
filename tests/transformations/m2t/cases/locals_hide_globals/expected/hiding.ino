// hiding: hiding.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t speed = 1;

void show(void) { pause(speed); }

int32_t speed_ = 24;

void setup() {
}

void loop() {
  show();
  pause(speed_);
}
