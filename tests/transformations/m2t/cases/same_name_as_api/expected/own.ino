// own: own.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int get_state(int pin) { return input(pin); }
int pause_time = 5;

void pause(int ms)
{
  waitcnt(CNT + ms * (CLKFREQ / 1000));
}

void setup() {
}

void loop() {
  if (get_state(3)) pause(pause_time);
}
