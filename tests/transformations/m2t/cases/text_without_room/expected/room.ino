// room: room.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

char code[3] = {'a', 'b', 'c'};

void setup() {
}

void loop() {
  pause((uint8_t)code[0]);
}
