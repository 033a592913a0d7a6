// Sleeps until somebody presses, then lights a lamp for a while.
#include <avr/sleep.h>

volatile bool pressed = false;

void wake() { pressed = true; }

void setup() {
  pinMode(2, INPUT_PULLUP);
  pinMode(9, OUTPUT);
  attachInterrupt(digitalPinToInterrupt(2), wake, FALLING);
  set_sleep_mode(SLEEP_MODE_IDLE);
}

void loop() {
  sleep_enable();
  sleep_mode();
  sleep_disable();
  if (pressed) {
    pressed = false;
    digitalWrite(9, HIGH);
    delay(40);
    digitalWrite(9, LOW);
  }
}
