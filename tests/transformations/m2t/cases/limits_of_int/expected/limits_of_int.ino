// limits_of_int: limits_of_int.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t limits[] = {32767, (int32_t)32768, -32768, (int32_t)-32769, (int32_t)2147483647};
uint32_t tops[] = {65535, (uint32_t)65536};

void setup() {
}

void loop() {
  high(port(limits[0]));
  low(port(tops[0]));
}
