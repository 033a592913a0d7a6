// arguments: arguments.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int argc = 0;
char **argv = 0;
int32_t i;

void setup() {
}

void loop() {
  for (i = 0; i < argc; i++) print("%s\n", argv[i]);
  pause(10);
}
