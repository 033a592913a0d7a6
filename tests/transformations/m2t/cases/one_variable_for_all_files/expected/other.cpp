// main: other.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

extern int32_t count;
int32_t left __attribute__((weak)), right __attribute__((weak));
int32_t st_timeout = 250;
int32_t later(int32_t n) { left = n; return count + right; }
