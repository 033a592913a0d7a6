// constant: constant.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t next;
int32_t room;

void setup() {
  const int32_t base = 5;
  next = base + 1;
  room = sizeof(next);
}

void loop() {
  next += room;
  pause(next);
}
