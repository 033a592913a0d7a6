// Adapters for Arduino Uno: what the program uses of propeller, with the signatures and widths it had there.
#pragma once

#include <Arduino.h>

// Exact; ticks of the virtual counter in a second, not the clock of the target
#define CLKFREQ 80000000L

// system counter, one step a clock tick
static uint32_t CNT = 0;  // TODO: complete symbol

// states of the pins, a bit each
static uint32_t INA = 0;  // TODO: complete symbol

// void pause(int time)  [simpletools.h]
// called in line 16
// it blocks
void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}

// void waitcnt(int ticks)  [propeller.h]
// called in line 6
// it blocks
void waitcnt(int32_t ticks) {
  // TODO: complete method
  (void)ticks;
}
