// order: order.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t twice(int32_t n);          // declared, then defined
static float half(float x);

// Functions that are used before they are defined
void late(int32_t n);

int32_t n;

void setup() {
  n = twice(2);
  late(n);
}

void loop() {
  n = twice(n);
  half(n);
  pause(n);
}

int32_t twice(int32_t n) { return 2 * n; }
static float half(float x) { return x / 2; }
void late(int32_t n) { pause(n); }
int32_t twice(int32_t n);
