// long: long.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t table[2][3] =   /* rows */
  {
    {1, 2, 3},        // first
    {4, 5, 6}         // second
  };                  // end of table
int32_t
    index             // where
    = 0;

void setup() {
}

void loop() {
  index = (index + 1) % 3;
  pause(table[1][index]);
}
