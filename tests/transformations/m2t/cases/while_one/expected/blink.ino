// blink: blink.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

/* A title
   of two lines. */

int32_t count = 0;  // how often

// Blinks once.
void blink(int32_t pin)
{
  high(pin);
  pause(100);
  low(pin);
}

// Comment on main.
// behind main
void setup() {
  // First the direction.
  set_direction(255 /* P26 is not wired yet */, 1);

  blink(255 /* P26 is not wired yet */);  // say hello
}

// for ever
void loop() {
  // In the loop.
  blink(255 /* P26 is not wired yet */);
  count++;

  if (count > 10) {
    count = 0;
  }
}
// behind the loop
// The end.
