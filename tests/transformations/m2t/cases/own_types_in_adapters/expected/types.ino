// types: types.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

typedef struct { int32_t x; int32_t y; } point;
struct robot { point where; };
typedef enum { SLOW, FAST } pace;

struct robot r;
point home;

// void mystery_move(struct robot *, point, int)
// called in line 15
// no header declares it: its signature is inferred from the calls
void mystery_move(struct robot *argument1, point argument2, int32_t argument3) {
  // TODO: complete method
  (void)argument1;
  (void)argument2;
  (void)argument3;
}

// void mystery_show(point *)
// called in line 16
// no header declares it: its signature is inferred from the calls
void mystery_show(point *argument1) {
  // TODO: complete method
  (void)argument1;
}

// point *mystery_target(void)
// called in line 13
// no header declares it: its signature is inferred from the calls
point *mystery_target() {
  // TODO: complete method
  return 0;
}

pace p = FAST;
point *there;

void setup() {
  there = mystery_target();
}

void loop() {
  mystery_move(&r, home, p);
  mystery_show(&home);
  pause(there->x);
}
