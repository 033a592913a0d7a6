// hiding: hiding.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int speed = 1;

void show(void) { pause(speed); }

void setup() {
  int speed = 24;
  while (1) {
    show();
    pause(speed);
  }
}

void loop() {
}
