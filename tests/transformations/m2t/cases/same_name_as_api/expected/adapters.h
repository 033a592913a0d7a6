// Adapters for Arduino Uno: what the program uses of propeller, with the signatures and widths it had there.
#pragma once

#include <Arduino.h>

// Exact; ticks of the virtual counter in a second, not the clock of the target
#define CLKFREQ 80000000L

// system counter, one step a clock tick
static uint32_t CNT = 0;  // TODO: complete symbol

// int input(int pin)  [simpletools.h]
// called in line 3
int32_t input(int32_t pin) {
  // TODO: complete method
  (void)pin;
  return 0;
}

// void waitcnt(int ticks)  [propeller.h]
// called in line 8
// it blocks
void waitcnt(int32_t ticks) {
  // TODO: complete method
  (void)ticks;
}
