// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// int print(const char *format, ...)  [simpletext.h]
// called in lines 23, 24
inline int32_t print(const char *format, ...) {
  // TODO: complete method
  (void)format;
  return 0;
}
