// prototypes_behind_types: prototypes_behind_types.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "points.h"

void first(void) { low(255 /* P1 is not wired yet */); }

typedef struct { int32_t left, right; } Pair;

// Functions that are used before they are defined
int32_t third(Pair *pair);

void second(void) {
  Pair pair = {1, 2};
  third(&pair);
}

int32_t third(Pair *pair) {
  return pair->left + pair->right;
}

void setup() {
  first();
  second();
  corners();
}

void loop() {
}
