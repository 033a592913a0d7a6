// header_without_guard: header_without_guard.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "wander.h"
#include "sensor.h"
#include "wander.h"

// Functions that are used before they are defined
void wander();

void setup() {
  wander();
  return (void)(distance() + level());
}

void loop() {
}

void wander() {}
