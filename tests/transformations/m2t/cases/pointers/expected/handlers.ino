// handlers: handlers.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

typedef void (*handler)(int);
static int seen[4];

void note(int n) { seen[n & 3]++; }
void apply(handler f, int n) { f(n); }
int compare(const void *a, const void *b) { return *(const int *)a - *(const int *)b; }

int low_ = 0, high_ = 0;
int *best;
handler chosen;

void setup() {
  best = &seen[1];
  chosen = note;
}

void loop() {
  apply(chosen, *best);
  apply(&note, 2);
  qsort(seen, 4, sizeof(int), compare);
  input_pair(&low_, &high_);
  register_handler(note);
}
