// index: index.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

struct config { int32_t pin; int32_t speed; };
int32_t table[4] = { {}, {}, 5 };
struct config left = { 3, 24 };

void setup() {
}

void loop() {
  pause(table[2] + left.speed);
}
