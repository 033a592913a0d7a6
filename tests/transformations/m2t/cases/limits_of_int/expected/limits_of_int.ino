// limits_of_int: limits_of_int.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int limits[] = {32767, (int)32768, -32768, (int)-32769, (int)2147483647};
unsigned tops[] = {65535, (unsigned)65536};

void setup() {
}

void loop() {
  high(limits[0]);
  low(tops[0]);
}
