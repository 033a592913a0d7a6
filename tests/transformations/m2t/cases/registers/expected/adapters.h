// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// clock ticks a second
static uint32_t CLKFREQ = 0;  // TODO: complete symbol

// system counter, one step a clock tick
static uint32_t CNT = 0;  // TODO: complete symbol

// directions of the pins, a bit each, 1 is output
static uint32_t DIRA = 0;  // TODO: complete symbol

// step of counter A
static uint32_t FRQA = 0;  // TODO: complete symbol

// states of the pins, a bit each
static uint32_t INA = 0;  // TODO: complete symbol

// output levels of the pins, a bit each
static uint32_t OUTA = 0;  // TODO: complete symbol

// void waitcnt(int ticks)  [propeller.h]
// called in line 14
// it blocks
void waitcnt(int32_t ticks) {
  // TODO: complete method
  (void)ticks;
}
