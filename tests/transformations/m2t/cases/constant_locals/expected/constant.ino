// constant: constant.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int next;
int room;

void setup() {
  const int base = 5;
  next = base + 1;
  room = sizeof(next);
}

void loop() {
  next += room;
  pause(next);
}
