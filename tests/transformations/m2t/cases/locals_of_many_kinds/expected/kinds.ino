// kinds: kinds.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

// the library

int32_t count = 9;                     // a global that a local hides

int32_t next(void) { return ++count; }

int32_t x, y, z;                     // three of one type
int32_t first, second = 2;
const char *text = "go", *other;
int32_t fast = 3;
static int32_t kept;
int32_t count_ = 1;                   // not the global
int32_t left;
void (*act)(int32_t);
int32_t HIGH_ = 4;

// starts here
void setup() {
  first = next();  /* one of them constant */
  other = text;
  left = count_ + 1;
  act = high;
}

void loop() {
  x = first + second + left;
  y = x + count_ + next() + HIGH_;
  z = y + fast + kept++;
  act(port(z));
  print("%s %s %d\n", text, other, z);
}
