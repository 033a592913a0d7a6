// start: work.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void work(void) { toggle(255 /* P2 is not wired yet */); }
