// words: words.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#define SET_NEW(x) new_ = (x)

struct class_ { int32_t this_; struct class_ *private_; };
int32_t new_;
static int32_t template_[2];

int32_t delete_(int32_t try_)
{
  return try_ + new_;
}

struct class_ object;

void setup() {
  int32_t public_ = 2;
  object.this_ = public_;
  object.private_ = &object;
}

void loop() {
  SET_NEW(delete_(1));
  template_[0] = object.this_ + object.private_->this_;
  pause(template_[0]);
}
