// old: old.c moved from propeller to Arduino Uno.
// Made by RoboSMi 0.1.0. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

static int count;
extern int ready();
int ready();

int add(int a, int b)
{
  return a + b;
}

float scale(float x, float factor)
{
  return x * factor;
}

int nothing() { count = 1; return 0; }

void setup() {
  nothing();
}

void loop() {
  count = add(count, 1);
  pause((int)scale(count, 2.0));
}

int ready() { return 1; }
