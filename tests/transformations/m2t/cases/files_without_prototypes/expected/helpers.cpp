// robot: helpers.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

static int counter = 7;            // another counter
extern const int limit = 10;

// Functions that are used before they are defined
int more(int x);

int twice(int x) { return 2 * x + more(counter++); }
int more(int x) { return x - 1; }
void show() { print("%d\n", counter); }
