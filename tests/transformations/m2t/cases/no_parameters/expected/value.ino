// value: value.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

typedef int32_t (*reader)(int32_t);
reader read_pin = input;

void setup() {
}

void loop() {
  pause(read_pin(port(3)));
}
