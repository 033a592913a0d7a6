// clashes: clashes.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#define LOW_SPEED 2
#define min_(a, b) ((a) < (b) ? (a) : (b))

int F_ = 3;
int B1_ = 4;
int input_pin = 1;
int word_;
static int map_[3];
enum { OUTPUT_ON, HIGH_ = 1 };

void delay_(int n) { pause(n); }
int abs_(int n) { return n < 0 ? -n : n; }
int digitalRead_(int pin) { return input(pin) + F_ + B1_; }

int A0_ = 2;
int yield_ = 1;

void setup() {
  high(input_pin);
  low(A0_);
}

void loop() {
  delay_(min_(F_, abs_(-4)));
  word_ = digitalRead_(5) + map_[0] + HIGH_ + yield_;
  if (word_ == OUTPUT_ON) toggle(A0_);
}
