// functions_of_others_with_types_of_the_platform: functions_of_others_with_types_of_the_platform.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

fdserial *line;
// Functions that are used before they are defined
int32_t later(fdserial *to);
int32_t helper(fdserial *to);

void setup() {
  line = fdserial_open(255 /* P3 is not wired yet */, 255 /* P4 is not wired yet */, 0, 9600); helper(line); later(line); return;
}

void loop() {
}
int32_t later(fdserial *to) { return fdserial_rxReady(to); }
