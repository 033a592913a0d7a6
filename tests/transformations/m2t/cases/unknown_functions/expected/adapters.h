// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

// void mystery_fill(char *, int)
// called in line 13
// no header declares it: its signature is inferred from the calls
void mystery_fill(char *argument1, int32_t argument2) {
  // TODO: complete method
  (void)argument1;
  (void)argument2;
}

// int mystery_read(int, int)
// called in lines 6, 11
// no header declares it: its signature is inferred from the calls
int32_t mystery_read(int32_t argument1, int32_t argument2) {
  // TODO: complete method
  (void)argument1;
  (void)argument2;
  return 0;
}

// int mystery_ready(void)
// called in line 14
// no header declares it: its signature is inferred from the calls
int32_t mystery_ready() {
  // TODO: complete method
  return 0;
}

// void mystery_show(const char *, int, float)
// called in line 12
// no header declares it: its signature is inferred from the calls
void mystery_show(const char *argument1, int32_t argument2, float argument3) {
  // TODO: complete method
  (void)argument1;
  (void)argument2;
  (void)argument3;
}

// void mystery_start(void)
// called in line 9
// no header declares it: its signature is inferred from the calls
void mystery_start() {
  // TODO: complete method
}

// void pause(int time)  [simpletools.h]
// called in line 14
// it blocks
void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}
