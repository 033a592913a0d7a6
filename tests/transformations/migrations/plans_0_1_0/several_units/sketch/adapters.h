// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// void low(int pin)  [simpletools.h]
// called in line 10
inline void low(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// int print(const char *format, ...)  [simpletext.h]
// called in line 11
inline int32_t print(const char *format, ...) {
  // TODO: complete method
  (void)format;
  return 0;
}

// void pulse_out(int pin, int time)  [simpletools.h]
// called in line 16
// it blocks
inline void pulse_out(int32_t pin, int32_t time) {
  // TODO: complete method
  (void)pin;
  (void)time;
}
