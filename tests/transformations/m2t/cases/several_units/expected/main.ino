// main: main.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "motor.h"

int32_t speed = 24;

void setup() {
  motor_start(MOTOR_PIN);
}

void loop() {
  motor_step(speed);
  print("%d\n", steps);
}
