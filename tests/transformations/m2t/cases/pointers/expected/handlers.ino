// handlers: handlers.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

typedef void (*handler)(int32_t);
static int32_t seen[4];

void note(int32_t n) { seen[n & 3]++; }
void apply(handler f, int32_t n) { f(n); }
int32_t compare(const void *a, const void *b) { return *(const int32_t *)a - *(const int32_t *)b; }

int32_t low_ = 0, high_ = 0;
int32_t *best;
handler chosen;
int32_t *same, *other;

void setup() {
  best = &seen[1];
  chosen = note;
  same = (&low_); other = ( /* ( */ (&high_));
}

void loop() {
  apply(chosen, *best + *same + *other);
  apply(&note, 2);
  qsort(seen, 4, sizeof(int32_t), [](const void *a, const void *b) -> int { int32_t order = compare(a, b); return (order > 0) - (order < 0); });
  input_pair(&low_, &high_);
  register_handler(note);
}
