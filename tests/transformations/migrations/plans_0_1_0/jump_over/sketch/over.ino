// over: over.c moved from propeller to Arduino Uno.
// Made by RoboSMi 0.1.0. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int check(int n)
{
  if (n < 0) goto failed;
  int twice; twice = 2 * n;
  return twice;
failed:
  return -1;
}

void setup() {
}

void loop() {
  pause(check(3));
}
