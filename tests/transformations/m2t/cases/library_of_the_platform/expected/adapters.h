// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

struct echo {};  // TODO: complete symbol

// int print(const char *format, ...)  [simpletext.h]
// called in line 7
inline int32_t print(const char *format, ...) {
  // TODO: complete method
  (void)format;
  return 0;
}

// long pulse_in(int pin, int state)  [simpletools.h]
// called in line 3
// it blocks
inline int32_t pulse_in(int32_t pin, int32_t state) {
  // TODO: complete method
  (void)pin;
  (void)state;
  return 0;
}
