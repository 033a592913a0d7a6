// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// void high(int pin)  [simpletools.h]
// called in line 5
void high(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// int input(int pin)  [simpletools.h]
// called in line 6
int32_t input(int32_t pin) {
  // TODO: complete method
  (void)pin;
  return 0;
}

// void low(int pin)  [simpletools.h]
// called in line 7
void low(int32_t pin) {
  // TODO: complete method
  (void)pin;
}
