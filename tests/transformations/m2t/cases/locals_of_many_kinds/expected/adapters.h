// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// void high(int pin)  [simpletools.h]
// used without a call, or in the body of a macro
// it is handed on as a value, so its types are those it had
void high(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// int print(const char *format, ...)  [simpletext.h]
// called in line 23
int32_t print(const char *format, ...) {
  // TODO: complete method
  (void)format;
  return 0;
}
