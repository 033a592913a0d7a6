// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// int input(int pin)  [simpletools.h]
// called in lines 14, 24
int32_t input(int32_t pin) {
  // TODO: complete method
  (void)pin;
  return 0;
}

// int print(const char *format, ...)  [simpletext.h]
// called in line 28
int32_t print(const char *format, ...) {
  // TODO: complete method
  (void)format;
  return 0;
}

// unsigned int toggle(int pin)  [simpletools.h]
// called in lines 3, 29
uint32_t toggle(int32_t pin) {
  // TODO: complete method
  (void)pin;
  return 0;
}
