// enums: enums.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

typedef enum { NORTH, EAST, SOUTH, WEST } heading;
enum color { RED, GREEN } paint = RED;
heading now = NORTH;

heading turn(heading h) { return (heading)(((uint32_t)h + 1) % 4); }

heading h;

void setup() {
}

void loop() {
  now = (heading)(now + 1);
  now = (heading)(now + (1UL));
  h = (heading)((now = (heading)(now - 1)) + 1);
  h = (heading)(h - 1);
  for (h = NORTH; (uint32_t)h <= WEST; h = (heading)(h + 1)) pause(h);
  paint = (enum color)!paint;
  now = (heading)((uint32_t)turn(h) | 1);
  if ((uint32_t)now == 2) now = h;
}
