// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// double __builtin_cbrt(double)
// called in line 11
// no header declares it: its signature is inferred from the calls
// the target has a __builtin_cbrt too, so this one has another name there
double propeller___builtin_cbrt(double argument1) {
  // TODO: complete method
  (void)argument1;
  return 0;
}

// int print(const char *format, ...)  [simpletext.h]
// called in lines 9, 10, 11
int32_t print(const char *format, ...) {
  // TODO: complete method
  (void)format;
  return 0;
}

#undef __builtin_cbrt
#define __builtin_cbrt propeller___builtin_cbrt  // the target has a __builtin_cbrt of its own
