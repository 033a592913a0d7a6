// tentative: tentative.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

extern int counter;
int counter = 5;
static int flag;
int elsewhere;
int board[16];
extern volatile int later;
volatile int later = 2;

void setup() {
}

void loop() {
  counter += flag + elsewhere + later;
  board[0] = counter;
  pause(counter);
}
