// umlaut: umlaut.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t n = 1;  /* Zähler */

// Geschwindigkeit für den Motor: ±5 µs, Größe in °C
void setup() {
  print("\334bertragung l\344uft: %d\n", n);
}

void loop() {
  pause(n);  // Ende der Übung
}
