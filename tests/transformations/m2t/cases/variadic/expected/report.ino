// report: report.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>
#include <stdarg.h>

#include "adapters.h"

int32_t total(int32_t n, ...)
{
  int32_t i, sum = 0;
  va_list values;
  va_start(values, n);
  for (i = 0; i < n; i++) sum += va_arg(values, int32_t);
  va_end(values);
  return sum;
}

void setup() {
  print("start\n");
}

void loop() {
  print("%d and %d%c", total(2, 3L, 4L), total(0), CLREOL);
  printi("%x\n", 15);
  pause(1000);
}
