// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

const int32_t CLREOL = 1;  // TODO: complete symbol

// void pause(int time)  [simpletools.h]
// called in line 20
// it blocks
void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}

// int print(const char *format, ...)  [simpletext.h]
// called in lines 16, 18
int32_t print(const char *format, ...) {
  // TODO: complete method
  (void)format;
  return 0;
}

// int printi(const char *format, ...)  [simpletext.h]
// called in line 19
int32_t printi(const char *format, ...) {
  // TODO: complete method
  (void)format;
  return 0;
}
