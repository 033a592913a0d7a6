// declared_in_lists: work.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "shared.h"

static int32_t own_speed = 4;
extern int32_t first, second;
extern volatile int32_t stop;
int32_t step = 2;

void work(void)
{
  first = own_speed;
  second = step;
  total = table[0];
  stop = 1;
}
