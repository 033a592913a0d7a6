// choice: choice.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#define FAST 1

#if FAST
#define DELAY 10
static int32_t step(int32_t n) { return n * 2; }
#else
#define DELAY 100
static int32_t step(int32_t n) { return n; }
#endif

#ifdef DEBUG
#include <stdio.h>
int32_t debugLevel = 1;
#endif

int32_t n = 1;

void setup() {
}

void loop() {
  n = step(n);
  pause(DELAY);
}
