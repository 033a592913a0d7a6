// tabs: tabs.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t sum(int32_t a, int32_t b)
{
	return a + b;	// tab inside
}

int32_t n = 1;

void setup() {
  high(port(n));
}

void loop() {
  if (n)
      n = sum(n, 1);
  pause(n);
}
