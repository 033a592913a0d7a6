// robot: helpers.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

static int32_t counter = 7;            // another counter
extern const int32_t limit = 10;

// Functions that are used before they are defined
int32_t more(int32_t x);

int32_t twice(int32_t x) { return 2 * x + more(counter++); }
int32_t more(int32_t x) { return x - 1; }
void show() { print("%d\n", counter); }
