// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// void freqout(int pin, int msTime, int frequency)  [simpletools.h]
// called in line 25
// it blocks
void freqout(int32_t pin, int32_t msTime, int32_t frequency) {
  // TODO: complete method
  (void)pin;
  (void)msTime;
  (void)frequency;
}

// void high(int pin)  [simpletools.h]
// called in lines 12, 20, 23
void high(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// int input(int pin)  [simpletools.h]
// called in lines 20, 21
int32_t input(int32_t pin) {
  // TODO: complete method
  (void)pin;
  return 0;
}

// void low(int pin)  [simpletools.h]
// called in lines 13, 24
void low(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// void pause(int time)  [simpletools.h]
// called in line 26
// it blocks
void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}
