#include <avr/sleep.h>

void wake() {}

void setup() {
  attachInterrupt(digitalPinToInterrupt(2), wake, LOW);
  set_sleep_mode(SLEEP_MODE_PWR_DOWN);
}

void loop() {
  sleep_mode();
}
