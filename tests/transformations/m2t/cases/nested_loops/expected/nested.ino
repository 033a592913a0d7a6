// nested: nested.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void spin(void)
{
  while (1) toggle(7);
}

void setup() {
}

void loop() {
  int32_t n = 0;
  while (1) {
    if (++n > 5) break;
    for (;;) { if (input(n)) break; }
  }
  if (n > 6) spin();
}
