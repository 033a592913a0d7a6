// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// void cog_end(int *coginfo)  [simpletools.h]
// called in line 20
void cog_end(int32_t *coginfo) {
  // TODO: complete method
  (void)coginfo;
}

// int *cog_run(void (*function)(void *par), int stacksize)  [simpletools.h]
// called in line 19
// it starts code on another core there
int32_t *cog_run(void (*function)(void *par), int32_t stacksize) {
  // TODO: complete method
  (void)function;
  (void)stacksize;
  return 0;
}

// int cogstart(void (*func)(void *), void *par, void *stack, size_t stacksize)  [propeller.h]
// called in line 18
// it starts code on another core there
int32_t cogstart(void (*func)(void *), void *par, void *stack, uint32_t stacksize) {
  // TODO: complete method
  (void)func;
  (void)par;
  (void)stack;
  (void)stacksize;
  return 0;
}

// void low(int pin)  [simpletools.h]
// called in line 14
void low(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// void pause(int time)  [simpletools.h]
// called in lines 10, 23
// it blocks
void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}

// int print(const char *format, ...)  [simpletext.h]
// called in line 22
int32_t print(const char *format, ...) {
  // TODO: complete method
  (void)format;
  return 0;
}
