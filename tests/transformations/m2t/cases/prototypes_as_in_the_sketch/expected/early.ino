// early: early.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

// Functions that are used before they are defined
static void step(int32_t n);
int32_t delete_(int32_t new_);
int32_t add(int32_t a, int32_t b);
unsigned long shift(unsigned char n);

void setup() {
}

void loop() {
  step(255 /* P1 is not wired yet */);
  delete_(2);
  add(1, 2);
  pause(shift(3));
}

static void step(int32_t n) /* once */ { high(n); }
int32_t delete_(int32_t new_) { return new_; }
int32_t add(int32_t a, int32_t b) { return a + b; }
unsigned long  shift(unsigned char  n)   // by one
{
  return (int32_t)n << 1;
}
