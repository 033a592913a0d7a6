// leave: leave.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

void after_loop(void) { toggle(255 /* P1 is not wired yet */); }

int32_t tries;
int32_t level;

void after_loop_();
void end_of_main();

void setup() {
  tries = 0;
  again:
  tries++;
  level = 7;
  if (tries < 3) goto again;
}

void loop() {
  level--;
  while (input(255 /* P3 is not wired yet */)) {
    if (level) break;            // of the inner loop
  }
  switch (level) {
    case 3: break;
    case 2: return;            // of main's loop
  }
  if (level == 1) {
    return after_loop_();                       // of main's loop
  }
  if (level < 0) return (void)(input(255 /* P2 is not wired yet */)), end_of_main();
  after_loop();
}

void after_loop_() {
  // behind the loop
  print("%d %d\n", tries, level);
  while (1) toggle(port(level));
  end_of_main();
}

// main has ended: nothing is repeated any more
void end_of_main() {
  for (;;) yield();
}
