// bool: bool.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

typedef unsigned char byte_;
typedef int bool_;
#define true 1
#define false 0
#undef PI
#define PI 3

bool_ on = false;
byte_ count;

void setup() {
}

void loop() {
  on = !on;
  count += PI;
  if (on == true) pause(count);
}
