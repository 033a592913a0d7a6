// registers: registers.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#define LED (1L << 5)

uint32_t next;

void setup() {
  next = CNT + CLKFREQ / 10;
  DIRA |= LED;
  OUTA &= ~LED;
}

void loop() {
  OUTA ^= LED;
  if (INA & 1) FRQA = 5;
  next += CLKFREQ / 2;
  waitcnt(next);
}
