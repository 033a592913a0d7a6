// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// system counter, one step a clock tick
static uint32_t CNT = 0;  // TODO: complete symbol

// void drive_speed(int left, int right)  [abdrive.h]
// called in lines 32, 34, 36, 40
// it starts code on another core there
// P12 (left servo) is BasicServo2WriteP1
// P13 (right servo) is BasicServo1WriteP1
// P14 (left encoder) is not bound
// P15 (right encoder) is not bound
void drive_speed(int32_t left, int32_t right) {
  // TODO: complete method
  (void)left;
  (void)right;
}

// unsigned int get_state(int pin)  [simpletools.h]
// called in line 19
uint32_t get_state(int32_t pin) {
  // TODO: complete method
  (void)pin;
  return 0;
}

// void high(int pin)  [simpletools.h]
// called in line 37
void high(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// void low(int pin)  [simpletools.h]
// called in line 39
void low(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// void pause(int time)  [simpletools.h]
// called in line 38
// it blocks
void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}

// void set_direction(int pin, int direction)  [simpletools.h]
// called in lines 16, 18
void set_direction(int32_t pin, int32_t direction) {
  // TODO: complete method
  (void)pin;
  (void)direction;
}

// void set_output(int pin, int state)  [simpletools.h]
// called in line 15
void set_output(int32_t pin, int32_t state) {
  // TODO: complete method
  (void)pin;
  (void)state;
}

// void waitcnt(int ticks)  [propeller.h]
// called in lines 17, 20
// it blocks
void waitcnt(int32_t ticks) {
  // TODO: complete method
  (void)ticks;
}
