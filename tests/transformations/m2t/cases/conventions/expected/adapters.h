// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// void drive_speed(int left, int right)  [abdrive.h]
// called in line 8
// it starts code on another core there
// abdrive.left_servo (left servo) is BasicServo2WriteP1
// abdrive.right_servo (right servo) is BasicServo1WriteP1
// abdrive.left_encoder (left encoder) is not bound
// abdrive.right_encoder (right encoder) is not bound
void drive_speed(int32_t left, int32_t right) {
  // TODO: complete method
  (void)left;
  (void)right;
}

// void high(int pin)  [simpletools.h]
// called in line 10
void high(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// void low(int pin)  [simpletools.h]
// called in line 12
void low(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// void pause(int time)  [simpletools.h]
// called in line 11
// it blocks
void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}
