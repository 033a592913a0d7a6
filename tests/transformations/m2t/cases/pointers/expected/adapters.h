// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// void input_pair(int *, int *)
// called in line 20
// no header declares it: its signature is inferred from the calls
void input_pair(int32_t *argument1, int32_t *argument2) {
  // TODO: complete method
  (void)argument1;
  (void)argument2;
}

// void register_handler(void *)
// called in line 21
// no header declares it: its signature is inferred from the calls
void register_handler(void (*argument1)(int32_t)) {
  // TODO: complete method
  (void)argument1;
}
