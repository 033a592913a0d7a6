// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

const int32_t CH_DN = 1;  // TODO: complete symbol

const int32_t CH_UP = 2;  // TODO: complete symbol

const int32_t MAX_LINE = 3;  // TODO: complete symbol

const int32_t VOL_UP = 4;  // TODO: complete symbol

// void high(int pin)  [simpletools.h]
// called in line 9
void high(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// void low(int pin)  [simpletools.h]
// called in line 10
void low(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// int sirc_key(int)
// called in line 8
// no header declares it: its signature is inferred from the calls
int32_t sirc_key(int32_t argument1) {
  // TODO: complete method
  (void)argument1;
  return 0;
}
