// casts: casts.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>
#include <stdlib.h>

#include "adapters.h"

struct class_ { int32_t n; };
typedef enum { NO, YES } this_;
this_ new_ = NO;

struct class_ *list;

void setup() {
  list = (struct class_ *)malloc(4);
}

void loop() {
  new_ = (this_)(new_ + 1);
  list->n = new_;
  new_ = (this_)list->n;
}
