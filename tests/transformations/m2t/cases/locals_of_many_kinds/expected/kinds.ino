// kinds: kinds.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

// the library

int count = 9;                     // a global that a local hides

int next(void) { return ++count; }

int x, y, z;                     // three of one type
int first, second = 2;
const char *text = "go", *other;
int fast = 3;
static int kept;
int count_ = 1;                   // not the global
int left;
void (*act)(int);
int HIGH_ = 4;

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
  act(z);
  print("%s %s %d\n", text, other, z);
}
