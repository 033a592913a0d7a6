// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// system counter, one step a clock tick
__attribute__((weak)) uint32_t CNT = 0;  // TODO: complete symbol

// void pause(int time)  [simpletools.h]
// called in line 10
// it blocks
inline void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}

// unsigned int toggle(int pin)  [simpletools.h]
// called in line 8
inline uint32_t toggle(int32_t pin) {
  // TODO: complete method
  (void)pin;
  return 0;
}
