// sizes: sizes.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#define SIZE 8
enum { ROWS = 2 };

char line[SIZE + 1L];
int32_t grid[ROWS][3] = {{0}};
char *names[] = {(char *)"left", (char *)"right"};
int32_t n = 2;

void setup() {
}

void loop() {
  line[n] = names[0][0];
  grid[1][n] = (uint8_t)line[n];
  pause(grid[1][n]);
}
