// Adapters for Arduino Uno: what the program uses of propeller, with the signatures and widths it had there.
#pragma once

#include <Arduino.h>

// Exact; ticks of the virtual counter in a second, not the clock of the target
#define CLKFREQ 80000000L

// system counter, one step a clock tick
static uint32_t CNT = 0;  // TODO: complete symbol

// directions of the pins, a bit each, 1 is output
static uint32_t DIRA = 0;  // TODO: complete symbol

// output levels of the pins, a bit each
static uint32_t OUTA = 0;  // TODO: complete symbol

// void waitcnt(int ticks)  [propeller.h]
// called in line 9
// it blocks
void waitcnt(int32_t ticks) {
  // TODO: complete method
  (void)ticks;
}
