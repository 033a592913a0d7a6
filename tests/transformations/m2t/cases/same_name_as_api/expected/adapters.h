// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// clock ticks a second
static uint32_t CLKFREQ = 0;  // TODO: complete symbol

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
