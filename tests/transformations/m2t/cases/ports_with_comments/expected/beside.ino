// beside: beside.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#define LED 13      // the light
#define BUTTON (2)  /* the button */
static const int32_t buzzer = 4, relay = 5;  // both
const int32_t sensor /* left */ = /* was 2 */ A1;

void setup() {
}

void loop() {
  if (input(BUTTON)) high(LED);
  toggle(buzzer);
  toggle(relay);
  pause(input(sensor));
}
