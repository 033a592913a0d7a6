// cores: cores.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

volatile int shared;
unsigned int stack[40 + 25];

void worker(void *par)
{
  while (1) {
    shared++;
    pause(10);
  }
}

void second(void) { while (1) low(3); }

int cog;

void setup() {
  cog = cogstart(&worker, NULL, stack, sizeof(stack));
  int *handle = cog_run((void (*)(void *par))second, 10);
  cog_end(handle);
}

void loop() {
  print("%d %d\n", shared, cog);
  pause(500);
}
