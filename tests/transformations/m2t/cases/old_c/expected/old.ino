// old: old.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

static int32_t count;
extern int32_t ready();
int32_t ready();

int32_t add(int32_t a, int32_t b)
{
  return a + b;
}

float scale(float x, float factor)
{
  return x * factor;
}

int32_t nothing() { count = 1; return 0; }

void setup() {
  nothing();
}

void loop() {
  count = add(count, 1L);
  pause((int32_t)scale(count, 2.0));
}

int32_t ready() { return 1; }
