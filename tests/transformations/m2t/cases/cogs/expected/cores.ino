// cores: cores.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

volatile int32_t shared;
uint32_t stack[40L + 25];

void worker(void *par)
{
  while (1) {
    shared++;
    pause(10);
  }
}

void second(void) { while (1) low(255 /* P3 is not wired yet */); }

int32_t cog;

void setup() {
  cog = cogstart(&worker, NULL, stack, sizeof(stack));
  int32_t *handle = cog_run((void (*)(void *par))second, 10);
  cog_end(handle);
}

void loop() {
  print("%d %d\n", shared, cog);
  pause(500);
}
