// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// system counter, one step a clock tick
static uint32_t CNT = 0;  // TODO: complete symbol

#define _NATIVE  // TODO: complete symbol

static uint32_t _clkfreq = 0;  // TODO: complete symbol

// void cognew(unsigned int *argument1, volatile void *handed)  [propeller.h]
// called in line 23
// it starts code on another core there
void cognew(uint32_t *argument1, volatile void *handed) {
  // TODO: complete method
  (void)argument1;
  (void)handed;
}

// void waitcnt(int ticks)  [propeller.h]
// called in line 33
// it blocks
void waitcnt(int32_t ticks) {
  // TODO: complete method
  (void)ticks;
}
