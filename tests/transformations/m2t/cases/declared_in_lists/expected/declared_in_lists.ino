// declared_in_lists: declared_in_lists.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "shared.h"

struct point { int32_t x; char name; };
int32_t first, second;
int32_t *place, numbers[16], grid[2][3], (*chosen)(int32_t);
struct point here, there[2];
extern const int32_t limit = {0}, others[2] = {0};
extern volatile int32_t stop, known; __typeof__(stop) stop;
volatile int32_t known = 3;
int32_t half(int32_t), sum(int32_t, char *);
int32_t half(int32_t argument1) {
  // TODO: complete method
  (void)argument1;
  return 0;
}
int32_t sum(int32_t argument1, char *argument2) {
  // TODO: complete method
  (void)argument1;
  (void)argument2;
  return 0;
}
int32_t ready(void), count;
int32_t ready() {
  // TODO: complete method
  return 0;
}

int32_t own(void)
{
  static int32_t inner, outer;
  return inner + outer;
}

void setup() {
  work();
  print("%d %d", first + second + *place + numbers[1] + grid[1][1] + chosen(2) + here.x + there[1].x + limit, others[1]);
  print("%d %d", stop + known + half(2) + sum(3, (char *)"a") + ready() + count + own(), total + table[1] + step);
  return;
}

void loop() {
}
