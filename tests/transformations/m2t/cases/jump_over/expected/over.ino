// over: over.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t check(int32_t n)
{
  if (n < 0) goto failed;
  int32_t twice; twice = 2 * n;
  return twice;
failed:
  return -1L;
}

void setup() {
}

void loop() {
  pause(check(3));
}
