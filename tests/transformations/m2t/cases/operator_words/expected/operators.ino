// operators: operators.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int and_, or_;
int not_(int xor_) { return !xor_; }

void setup() {
}

void loop() {
  and_ = not_(or_);
  pause(and_);
}
