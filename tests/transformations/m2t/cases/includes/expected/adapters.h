// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

typedef int32_t useconds_t;  // TODO: complete symbol

// void pause(int time)  [simpletools.h]
// called in line 18
// it blocks
void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}

// int servo_speed(int pin, int speed)  [servo.h]
// called in line 15
// it starts code on another core there
int32_t servo_speed(int32_t pin, int32_t speed) {
  // TODO: complete method
  (void)pin;
  (void)speed;
  return 0;
}

// int usleep(useconds_t usec)  [sys/unistd.h]
// called in line 17
// it blocks
int32_t usleep(useconds_t usec) {
  // TODO: complete method
  (void)usec;
  return 0;
}
