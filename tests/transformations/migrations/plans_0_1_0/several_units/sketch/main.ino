// main: main.c moved from propeller to Arduino Uno.
// Made by RoboSMi 0.1.0. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "motor.h"

int speed = 24;

void setup() {
  motor_start(MOTOR_PIN);
}

void loop() {
  motor_step(speed);
  print("%d\n", steps);
}
