// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// int *cog_run(void (*function)(void *par), int stacksize)  [simpletools.h]
// called in line 7
// it starts code on another core there
int32_t *cog_run(void (*function)(void *par), int32_t stacksize) {
  // TODO: complete method
  (void)function;
  (void)stacksize;
  return 0;
}

// void pause(int time)  [simpletools.h]
// called in line 13
// it blocks
void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}

// unsigned int toggle(int pin)  [simpletools.h]
// called in line 20
uint32_t toggle(int32_t pin) {
  // TODO: complete method
  (void)pin;
  return 0;
}
