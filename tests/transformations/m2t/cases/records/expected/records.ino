// records: records.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

typedef unsigned char byte_t;
typedef enum { STOPPED, RUNNING = 5 } state_t;
typedef struct {
  byte_t low : 4;
  byte_t high : 4;
} nibbles;
union number {
  int32_t whole;
  float part;
};

static state_t state = STOPPED;
nibbles pair = {1, 2};
union number u;

void setup() {
  u.whole = 3;
}

void loop() {
  switch (state) {
    case STOPPED:
      state = RUNNING;
      break;
    case RUNNING:
      pair.low++;
      /* falls through */
    default:
      pause(u.whole + pair.high);
  }
}
