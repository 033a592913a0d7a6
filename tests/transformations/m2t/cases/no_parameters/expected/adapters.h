// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// The pin of each port of propeller; 255 is no pin: a port that is not wired.
const uint8_t port_pins[32] = {
  255,  // P0
  255,  // P1
  255,  // P2
  255,  // P3
  255,  // P4
  255,  // P5
  255,  // P6
  255,  // P7
  255,  // P8
  255,  // P9
  255,  // P10
  255,  // P11
  255,  // P12
  255,  // P13
  255,  // P14
  255,  // P15
  255,  // P16
  255,  // P17
  255,  // P18
  255,  // P19
  255,  // P20
  255,  // P21
  255,  // P22
  255,  // P23
  255,  // P24
  255,  // P25
  255,  // P26
  255,  // P27
  255,  // P28
  255,  // P29
  255,  // P30
  255,  // P31
};

// The pin of a port of propeller, which the program has as a number; what is negative stays.
inline int32_t port(int32_t number) {
  if (!__builtin_constant_p(number)) asm("" : "+r"(number));  // what has no value (1/0) is compared, too
  return number < 0 ? number : number < 32 ? port_pins[number] : 255;
}

// int input(int pin)  [simpletools.h]
// used without a call, or in the body of a macro
// the program uses it as a value, so its types are unchanged
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
