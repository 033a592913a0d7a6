// unknown: unknown.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t n;
float f = 1.5;
char text[10];

void setup() {
  n = mystery_read(3, 4);
  mystery_start();
}

void loop() {
  n = mystery_read(n, 2);
  mystery_show("n = ", n, f);
  mystery_fill(text, sizeof(text));
  if (mystery_ready()) pause(n);
}
