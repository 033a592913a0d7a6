// main: main.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>
#include <stdlib.h>

#include "adapters.h"

int32_t count;
int32_t left, right = 5;
typedef struct step_ *step;
typedef struct { int32_t at; } place;
struct step_ { ::place place; step next; };
int32_t sum(int32_t n, int32_t list[]);
int32_t later(int32_t n);

// Variables of other files
extern int32_t st_timeout;

int32_t sum(int32_t n, int32_t list[])
{
  int32_t total = 0;
  while (n--) total += list[n];
  return total;
}

void setup() {
  unsigned char text[8] = "70000";
  int32_t few[2] = { 1, 2 };
  step first = (step)malloc(sizeof(struct step_));
  first->place.at = atol((const char *)text);
  first->next = NULL;
  count = sum(2, few) + later(3L) + first->place.at;
  print("%d %d %d %d\n", count, left, right, st_timeout);
  return;
}

void loop() {
}
