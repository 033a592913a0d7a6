// tabs: tabs.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int sum(int a, int b)
{
	return a + b;	// tab inside
}

int n = 1;

void setup() {
  high(n);
}

void loop() {
  if (n)
      n = sum(n, 1);
  pause(n);
}
