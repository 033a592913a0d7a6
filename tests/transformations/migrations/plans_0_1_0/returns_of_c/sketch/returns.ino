// returns: returns.c moved from propeller to Arduino Uno.
// Made by RoboSMi 0.1.0. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int level;
int measure(int n) { if (n) return 0; return 5; }
void store(int n) { if (n > 2) return (void)(level = n); }
void show(void) { return store(3); }
int ask(int n) { if (n) return 1; else return 0; }
int wait_for(int n) { while (1) { if (input(n)) return n; } }
int last(int n) { switch (n) { case 1: return 2; } return 0; }

void setup() {
}

void loop() {
  measure(1);
  show();
  pause(level + ask(1) + wait_for(2) + last(1));
}
