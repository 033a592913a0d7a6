// clashes: clashes.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#define LOW_SPEED 2
#define min_(a, b) ((a) < (b) ? (a) : (b))

int32_t F_ = 3;
int32_t B1_ = 4;
int32_t input_pin = 255 /* P1 is not wired yet */;
int32_t word_;
static int32_t map_[3];
enum { OUTPUT_ON, HIGH_ = 1 };

void delay_(int32_t n) { pause(n); }
int32_t abs_(int32_t n) { return n < 0 ? -n : n; }
int32_t digitalRead_(int32_t pin) { return input(pin) + F_ + B1_; }

int32_t A0_ = 255 /* P2 is not wired yet */;
int32_t yield_ = 1;

void setup() {
  high(input_pin);
  low(A0_);
}

void loop() {
  delay_(min_(F_, abs_(-4L)));
  word_ = digitalRead_(255 /* P5 is not wired yet */) + map_[0] + HIGH_ + yield_;
  if (word_ == OUTPUT_ON) toggle(A0_);
}
