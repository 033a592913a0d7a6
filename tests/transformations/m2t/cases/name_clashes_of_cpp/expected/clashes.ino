// clashes: clashes.cpp moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

constexpr int32_t port_(int32_t n) { return 8 + n; }

struct Lamp {
  int32_t pin;
  void delay(int32_t ms) const { high(port(pin)); pause(ms); low(port(pin)); }
};

int32_t word_ = 3;
static Lamp lamp = {9};

void setup() {
}

void loop() {
  high(port(port_(0)));
  lamp.delay(100 * word_);
  low(port(port_(0)));
  pause(100);
}
