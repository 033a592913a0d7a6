// images: images.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>
#include <stdio.h>
#include <time.h>

#include "adapters.h"

typedef struct { char ids[8]; int32_t valid; } Sentence;

volatile Sentence last;

static _NATIVE
int32_t doubled(int32_t value)
{
  return 2 * value;
}

char *ids()
{
  return((char *)last.ids);
}

void start(volatile void *parameter)
{
  static uint32_t binary_blink_dat_start[16];
  cognew(binary_blink_dat_start, parameter);
}

int32_t levels[4];
int32_t at;

void setup() {
  at = (int32_t)&levels[1];
  start(&last);
}

void loop() {
  if (at < (int32_t)&levels[3]) printf("%s %ld\n", ids(), doubled(levels[0]));
  waitcnt(CNT + _clkfreq);
}
