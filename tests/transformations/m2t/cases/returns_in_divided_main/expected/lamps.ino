// lamps: lamps.cpp moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t lamp = 9;

void setup() {
  auto on = [](int32_t p) {
    if (p > 20) return;
    high(port(p));
  };
  on(lamp);
}

void loop() {
  auto off = [](int32_t p) {
    if (p > 20) return;
    low(port(p));
  };
  off(8);
  if (lamp > 9) return;
  pause(100);
}
