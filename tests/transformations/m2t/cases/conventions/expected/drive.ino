// drive: drive.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>
#include <Servo.h>

const int BasicServo2WriteP1 = 8;  // Basic Servo2: pulse on D8
const int BasicServo1WriteP1 = 9;  // Basic Servo1: pulse on D9
const int HIH40302ReadP1 = 10;  // HIH4030 2: OUT on D10
const int HIH40301ReadP1 = 11;  // HIH4030 1: OUT on D11
const int Red633nmLED1WriteP1 = 12;  // Red (633nm)-LED1: anode on D12

#include "adapters.h"

#define LED Red633nmLED1WriteP1

void setup() {
  digitalWrite(BasicServo2WriteP1, LOW);  // Basic Servo2 does nothing yet
  pinMode(BasicServo2WriteP1, OUTPUT);
  digitalWrite(BasicServo1WriteP1, LOW);  // Basic Servo1 does nothing yet
  pinMode(BasicServo1WriteP1, OUTPUT);
  drive_speed(24, 24);
}

void loop() {
  high(LED);
  pause(1000);
  low(LED);
}
