// first: second.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

static int32_t state = 100;
static int32_t next(void) { return state--; }

int32_t other(void)
{
  toggle(port(CNT & 1));
  return next();
}
