// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// int input(int pin)  [simpletools.h]
// used without a call, or in the body of a macro
// it is handed on as a value, so its types are those it had
int32_t input(int32_t pin) {
  // TODO: complete method
  (void)pin;
  return 0;
}

// void pause(int time)  [simpletools.h]
// called in line 8
// it blocks
void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}
