// returns: returns.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t level;
int32_t measure(int32_t n) { if (n) return 0; return 5; }
void store(int32_t n) { if (n > 2) return (void)(level = n); }
void show(void) { return store(3); }
int32_t ask(int32_t n) { if (n) return 1; else return 0; }
int32_t wait_for(int32_t n) { while (1) { if (input(port(n))) return n; } }
int32_t last(int32_t n) { switch (n) { case 1: return 2; } return 0; }

void setup() {
}

void loop() {
  measure(1);
  show();
  pause(level + ask(1) + wait_for(2) + last(1));
}
