// bool: bool.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

typedef unsigned char byte_;
typedef int32_t bool_;
#define true_ 1
#define false_ 0
#define PI_ 3

bool_ on = false_;
byte_ count;

void setup() {
}

void loop() {
  on = !on;
  count += (int32_t)PI_;
  if (on == true_) pause(count);
}
