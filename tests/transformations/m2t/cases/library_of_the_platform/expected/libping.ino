// libping: libping.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

/* Tries the library out. */
#include "ping.h"

void setup() {
}

void loop() {
  print("%d\n", ping_cm(255 /* P15 is not wired yet */));
}
