// Adapters for Arduino Uno: what the program uses of propeller, with the signatures and widths it had there.
#pragma once

#include <Arduino.h>

// Limit: the Serial Monitor of the Arduino IDE does not obey it; a Parallax terminal does
#define CLREOL 11L

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
