// own: own.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t get_state(int32_t pin) { return input(pin); }
int32_t pause_time = 5;

void pause(int32_t ms)
{
  waitcnt(CNT + ms * (CLKFREQ / 1000));
}

void setup() {
}

void loop() {
  if (get_state(255 /* P3 is not wired yet */)) pause(pause_time);
}
