// line_follower: line_follower.c moved from propeller to Arduino Uno.
// Made by RoboSMi 0.1.0. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>
#include <Servo.h>
#include <ServoEasing.hpp>

const int BasicServo2WriteP1 = 8;  // Basic Servo2: pulse on D8
const int BasicServo1WriteP1 = 9;  // Basic Servo1: pulse on D9
const int HIH40302ReadP1 = 10;  // HIH4030 2: OUT on D10
const int HIH40301ReadP1 = 11;  // HIH4030 1: OUT on D11
const int Red633nmLED1WriteP1 = 12;  // Red (633nm)-LED1: anode on D12

#include "adapters.h"

/* Line follower for the Propeller Activity Bot: two QTI sensors look at the floor, two servos drive, a LED marks a
   checkpoint. A dark floor lets the sensor's capacitor decay slowly, a light one fast. */

const int leftQTI  = HIH40302ReadP1;    // Left QTI port
const int rightQTI = HIH40301ReadP1;    // Right QTI port
const int LED      = 7;    // LED port
const int QTI_T    = 50;   // QTI sensor threshold, in polls of 20 us
const int waitTime = 230;  // QTI charging time in us, 80 clock ticks each

// Charge the sensor, release it, and count how long it takes to decay
long GetQTIState(int comPort) {
  long state = 0;
  set_output(comPort, 0b1);
  set_direction(comPort, 0b1);
  waitcnt(CNT + waitTime * 80);
  set_direction(comPort, 0b0);
  while (get_state(comPort) == 1 && state < 2 * QTI_T) {
    waitcnt(CNT + 1600);
    state++;
  }
  return state;
}

void setup() {
}

void loop() {
  long sLeft  = GetQTIState(leftQTI);
  long sRight = GetQTIState(rightQTI);

  if (sLeft < QTI_T && sRight < QTI_T)
    drive_speed(24, 24);   // continue straight
  else if (sLeft < QTI_T && sRight > QTI_T)
    drive_speed(24, 12);   // turn
  else if (sLeft > QTI_T && sRight > QTI_T) {
    drive_speed(0, 0);     // stop
    high(LED);             // switch on LED
    pause(1000);           // wait 1 s
    low(LED);              // switch off LED
    drive_speed(24, 24);   // continue
  }
}
