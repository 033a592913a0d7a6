// words: words.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#define SET_NEW(x) new_ = (x)

struct class_ { int this_; struct class_ *private_; };
int new_;
static int template_[2];

int delete_(int try_)
{
  return try_ + new_;
}

struct class_ object;

void setup() {
  int public_ = 2;
  object.this_ = public_;
  object.private_ = &object;
}

void loop() {
  SET_NEW(delete_(1));
  template_[0] = object.this_ + object.private_->this_;
  pause(template_[0]);
}
