// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// void high(int pin)  [simpletools.h]
// called in line 21
void high(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// int input(int pin)  [simpletools.h]
// called in line 15
int32_t input(int32_t pin) {
  // TODO: complete method
  (void)pin;
  return 0;
}

// void low(int pin)  [simpletools.h]
// called in line 22
void low(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// void pause(int time)  [simpletools.h]
// called in line 13
// it blocks
void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}

// unsigned int toggle(int pin)  [simpletools.h]
// called in line 26
uint32_t toggle(int32_t pin) {
  // TODO: complete method
  (void)pin;
  return 0;
}
