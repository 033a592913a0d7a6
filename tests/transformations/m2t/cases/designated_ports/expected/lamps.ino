// lamps: lamps.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

enum { RED, GREEN, BLUE, COUNT };
typedef struct { int32_t pin; int32_t ms; } lamp;
static const unsigned char ports[COUNT] = { 12, 13, 13 };
static const lamp lamps[] = { {8, 200}, {9, 100} };

void setup() {
}

void loop() {
  for (int32_t i = RED; i < COUNT; i++) high(ports[i]);
  pause(100);
  for (int32_t i = RED; i < COUNT; i++) low(ports[i]);
  for (int32_t i = 0; i < 2; i++) { high(port(lamps[i].pin)); pause(lamps[i].ms); low(port(lamps[i].pin)); }
}
