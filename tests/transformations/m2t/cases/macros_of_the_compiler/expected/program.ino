// program: program.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

// GCC's own names have the same meaning on the target: none of them gets a placeholder.

#if __GNUC__ >= 4
int32_t version = __GNUC__ * 100L + __GNUC_MINOR__;
#endif

void setup() {
  print("%d %s %d", version, __VERSION__, __CHAR_BIT__);
  return;
}

void loop() {
}
