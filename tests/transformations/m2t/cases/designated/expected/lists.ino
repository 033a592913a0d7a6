// lists: lists.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

struct config { int32_t pin; int32_t speed; char *name; };
struct config left = { .pin = 3, .speed = 24, .name = (char *)"left" };
struct config right = { 4, 12, (char *)"right" };
const int32_t table[4] = { 1, 2 };

void setup() {
}

void loop() {
  high(port(left.pin));
  low(port(right.pin));
  pause(table[0] + left.speed);
}
