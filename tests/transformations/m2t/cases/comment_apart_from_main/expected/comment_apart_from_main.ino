// comment_apart_from_main: comment_apart_from_main.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t pin = 3;  // behind a declaration

// Everything below is the program.

int32_t count = 0;

void setup() {
  // before the loop
}

void loop() {
  high(port(pin + count));
  count++;
}
