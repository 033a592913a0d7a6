// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// void low(int pin)  [simpletools.h]
// called in line 4
void low(int32_t pin) {
  // TODO: complete method
  (void)pin;
}
