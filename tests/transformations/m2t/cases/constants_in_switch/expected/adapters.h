// Adapters for Arduino Uno: what the program uses of propeller, with the signatures and widths it had there.
#pragma once

#include <Arduino.h>

#define CH_DN 17
#define CH_UP 16
#define VOL_UP 18

const int32_t MAX_LINE = 7;  // TODO: complete symbol

// void high(int pin)  [simpletools.h]
// called in line 9
void high(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// void low(int pin)  [simpletools.h]
// called in line 10
void low(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// int sirc_key(int)
// called in line 8
// no header declares it: its signature is inferred from the calls
int32_t sirc_key(int32_t argument1) {
  // TODO: complete method
  (void)argument1;
  return 0;
}
