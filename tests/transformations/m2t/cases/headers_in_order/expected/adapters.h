// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// void drive_speed(int left, int right)  [abdrive.h]
// called in lines 3, 9
// it starts code on another core there
// abdrive.left_servo (left servo) is not bound
// abdrive.right_servo (right servo) is not bound
// abdrive.left_encoder (left encoder) is not bound
// abdrive.right_encoder (right encoder) is not bound
void drive_speed(int32_t left, int32_t right) {
  // TODO: complete method
  (void)left;
  (void)right;
}

// void pause(int time)  [simpletools.h]
// called in lines 4, 7
// it blocks
void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}

// int ping_cm(int pin)  [ping.h]
// called in line 9
// it blocks
int32_t ping_cm(int32_t pin) {
  // TODO: complete method
  (void)pin;
  return 0;
}
