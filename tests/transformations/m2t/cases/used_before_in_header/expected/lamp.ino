// lamp: lamp.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "lamp.h"

void setup() {
}

void loop() {
  flash(3);
}
