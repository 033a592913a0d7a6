// either: either.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#define NEW_BOARD

#ifdef NEW_BOARD
void lamp(int32_t on)
{
  if (on) high(255 /* P26 is not wired yet */); else low(255 /* P26 is not wired yet */);
}
#else
void lamp(int32_t on)
{
  OUTA |= on << 26;
}
#endif

void setup() {
}

void loop() {
#ifdef NEW_BOARD
  lamp(1);
#else
  lamp(0);
#endif
  pause(10);
}
