// nested: nested.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void spin(void)
{
  while (1) toggle(255 /* P7 is not wired yet */);
}

void setup() {
}

void loop() {
  int32_t n = 0;
  while (1) {
    if (++n > 5) break;
    for (;;) { if (input(port(n))) break; }
  }
  if (n > 6) spin();
}
