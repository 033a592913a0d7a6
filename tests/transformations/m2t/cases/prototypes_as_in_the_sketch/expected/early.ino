// early: early.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

// Functions that are used before they are defined
static void step(int n);
int delete_(int new_);
int add(int a, int b);
unsigned long shift(unsigned char n);

void setup() {
}

void loop() {
  step(1);
  delete_(2);
  add(1, 2);
  pause(shift(3));
}

static void step(int n) /* once */ { high(n); }
int delete_(int new_) { return new_; }
int add(int a, int b) { return a + b; }
unsigned long  shift(unsigned char  n)   // by one
{
  return n << 1;
}
