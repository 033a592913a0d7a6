// registers_only_read: registers_only_read.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "times.h"

uint32_t started;

void setup() {
  waitcnt(CNT + (CLKFREQ / 1000));
  started = 5;
  (void)(CNT);
  (void)((CNT + 1));
  (void)(0);
  if ((INA | (4)) & 4) started = (CNT + 1);
  WAIT(CLKFREQ, 2);
}

void loop() {
  int32_t CNT_LEFT = 3;
  CNT_LEFT += 2;
  pause(CNT_LEFT);
}
