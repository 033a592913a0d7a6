// clashes: clashes.c moved from propeller to Arduino Uno.
// Made by RoboSMi 0.1.0. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#define LOW_SPEED 2
#undef min
#define min(a, b) ((a) < (b) ? (a) : (b))

int my_F = 3;
int B1_ = 4;
int input_pin = 1;
int word_;
static int map_[3];
enum { OUTPUT_ON, HIGH_ = 1 };

void delay_(int n) { pause(n); }
int abs_(int n) { return n < 0 ? -n : n; }
int digitalRead_(int pin) { return input(pin) + my_F + B1_; }

void setup() {
  int A0 = 2;
  int yield = 1;
  high(input_pin);
  low(A0);
  while (1) {
    delay_(min(my_F, abs_(-4)));
    word_ = digitalRead_(5) + map_[0] + HIGH_ + yield;
    if (word_ == OUTPUT_ON) toggle(A0);
  }
}

void loop() {
}
