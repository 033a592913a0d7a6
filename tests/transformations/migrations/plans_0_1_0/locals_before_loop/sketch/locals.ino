// locals: locals.c moved from propeller to Arduino Uno.
// Made by RoboSMi 0.1.0. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int first(void) { return 5; }

int limit = 10;            // a constant value
int start;
const int step = 2;
int offset;
static int calls = 0;
int values[3] = {1, 2, 3};
char name[] = "robot";
char *text;
const char *fixed = "fixed";
float ratio = 1.5f;
unsigned char flag;

void setup() {
  start = first();       // a call
  offset = first() + 1;
  text = name;
  int once = 7;
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
