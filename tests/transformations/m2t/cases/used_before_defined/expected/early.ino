// early: early.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

static int32_t stack[40];

// Functions that are used before they are defined
int32_t helper(int32_t n);
void worker(void *par);

void go(void) {
  helper(3);
  cog_run(worker, 40);
}

void setup() {
  go();
}

void loop() {
  pause(1000);
}

int32_t helper(int32_t n) { return n + stack[0]; }

void worker(void *par)
{
  while (1) { toggle(255 /* P4 is not wired yet */); }
}
