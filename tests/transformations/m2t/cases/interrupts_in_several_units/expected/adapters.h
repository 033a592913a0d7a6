// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// void drive_setRampStep(int stepsize)  [abdrive.h]
// called in line 6
inline void drive_setRampStep(int32_t stepsize) {
  // TODO: complete method
  (void)stepsize;
}

// void drive_speed(int left, int right)  [abdrive.h]
// called in lines 6, 10
// it starts code on another core there
// abdrive.left_servo (left servo) is not bound
// abdrive.right_servo (right servo) is not bound
// abdrive.left_encoder (left encoder) is not bound
// abdrive.right_encoder (right encoder) is not bound
inline void drive_speed(int32_t left, int32_t right) {
  // TODO: complete method
  (void)left;
  (void)right;
}

// void pause(int time)  [simpletools.h]
// called in line 9
// it blocks
inline void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}

// int print(const char *format, ...)  [simpletext.h]
// called in lines 7, 11
inline int32_t print(const char *format, ...) {
  // TODO: complete method
  (void)format;
  return 0;
}
