// lamps: lamps.cpp moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void setup() {
  auto on = [](int32_t p) {
    if (p > 20) return;
    high(port(p));
  };
  auto pin = [](int32_t i) -> int32_t { return 8 + i; };
  struct Lamp {
    int32_t p;
    int32_t pin() { return p; }
  };
  Lamp lamp;
  lamp.p = 9;
  on(lamp.pin());
  if (pin(0) > 9) return;
  while (1) {
    auto blink = [](int32_t p) -> int32_t { toggle(port(p)); return p; };
    if (blink(4) > 4) return;
    pause(100);
  }
}

void loop() {
}
