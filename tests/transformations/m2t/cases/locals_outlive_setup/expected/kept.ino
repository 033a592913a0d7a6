// kept: kept.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t *kept;
char *line;

int32_t value = 4;
char buffer[20];

void setup() {
  kept = &value;
  line = buffer;
}

void loop() {
  *kept = *kept + 1;
  line[0] = 'x';
  pause(*kept);
}
