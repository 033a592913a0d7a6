// operators: operators.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t and_, or_;
int32_t not_(int32_t xor_) { return !xor_; }

void setup() {
}

void loop() {
  and_ = not_(or_);
  pause(and_);
}
