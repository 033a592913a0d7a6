// keys: keys.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

char line[MAX_LINE];

void setup() {
}

void loop() {
  switch (sirc_key(10)) {
    case CH_UP: high(255 /* P1 is not wired yet */); break;
    case CH_DN: low(255 /* P1 is not wired yet */); break;
    case VOL_UP: line[0] = 'v'; break;
  }
}
