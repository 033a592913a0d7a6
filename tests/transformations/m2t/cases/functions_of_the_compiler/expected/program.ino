// program: program.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

// GCC's own functions: parity is counted over 32 bits, and a placeholder has no name that the target's compiler knows.

uint32_t seed = 0x80000001;

void setup() {
  uint32_t *room = (uint32_t *)__builtin_alloca(16);
  room[0] = seed;
  print("%d %d %d", __builtin_parityl(room[0]), __builtin_clzl(seed), __builtin_expect(seed > 1, 1));
  print("%d", __builtin_ctzl(seed) + __builtin_labs(-70000));
  print("%d", (int32_t) __builtin_cbrt(27.0));
  return;
}

void loop() {
}
