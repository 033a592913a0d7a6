// inside: inside.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#define LED 5

int32_t n = 0;

void setup() {
#ifdef LED
  high(port(LED));
#else
  low(1);
#endif
}

void loop() {
#if defined(LED) && LED > 3
  toggle(port(LED));
#endif
  n++;
  pause(n);
}
