// tentative: tentative.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

extern int32_t counter;
int32_t counter = 5;
static int32_t flag;
int32_t elsewhere;
int32_t board[16];
extern volatile int32_t later;
volatile int32_t later = 2;

void setup() {
}

void loop() {
  counter += flag + elsewhere + later;
  board[0] = counter;
  pause(counter);
}
