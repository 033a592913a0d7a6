// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// void high(int pin)  [simpletools.h]
// called in line 15
void high(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// void low(int pin)  [simpletools.h]
// called in line 17
void low(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// void pause(int time)  [simpletools.h]
// called in lines 16, 21
// it blocks
void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}
