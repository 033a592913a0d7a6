// locals: locals.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t first(void) { return 5; }

int32_t limit = 10;            // a constant value
int32_t start;
const int32_t step = 2;
int32_t offset;
static int32_t calls = 0;
int32_t values[3] = {1, 2, 3};
char name[] = "robot";
char *text;
const char *fixed = "fixed";
float ratio = 1.5f;
unsigned char flag;

void setup() {
  start = first();       // a call
  offset = first() + 1;
  text = name;
  int32_t once = 7;
  flag = 0;
  pause(once);
}

void loop() {
  calls += step + offset;
  values[calls % 3] = limit + start;
  flag = !flag;
  ratio = ratio * values[0] + flag;
  text[0] = fixed[0];
  pause(calls);
}
