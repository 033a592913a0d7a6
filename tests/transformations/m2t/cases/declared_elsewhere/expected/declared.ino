// declared: declared.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t adc_average(int32_t channel, const char *label) {
  // TODO: complete method
  (void)channel;
  (void)label;
  return 0;
}
void kick(void) {
  // TODO: complete method
}

void setup() {
}

void loop() {
  kick();
  pause(adc_average(2, "light"));
}
