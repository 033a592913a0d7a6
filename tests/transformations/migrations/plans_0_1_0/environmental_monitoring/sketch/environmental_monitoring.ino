// environmental_monitoring: environmental_monitoring.c moved from propeller to Arduino Uno.
// Made by RoboSMi 0.1.0. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <DHT.h>
#include <Servo.h>

const int IRReceiver2ReadP1 = 2;  // IR Receiver2: Data on D2
const int IRLED2WriteP1 = 3;  // IR LED2: anode on D3
const int LED1WriteP1 = 4;  // LED1: anode on D4
const int Piezo1WriteP1 = 4;  // Piezo1: pin2 on D4
const int DHT22ReadP1 = 7;  // DHT22: Data-signal on D7
const int BasicServo2WriteP1 = 8;  // Basic Servo2: pulse on D8
const int BasicServo1WriteP1 = 9;  // Basic Servo1: pulse on D9
const int IRLED1WriteP1 = 10;  // IR LED1: anode on D10
const int IRReceiver1ReadP1 = 11;  // IR Receiver1: Data on D11

#include "adapters.h"

/* Environmental monitoring on the Propeller Activity Board: the robot drives on its own, two pairs of infrared
   transmitters and receivers find obstacles, a DHT22 is read from time to time, and a LED with a buzzer tells when
   the air is too damp or too warm. */

#define CRUISE 60               // servo speed when nothing is in the way
#define TURN_MS 600             // a turn of about 90 degrees

const int leftServo = BasicServo2WriteP1;       // servos, continuous rotation
const int rightServo = BasicServo1WriteP1;
const int irLedLeft = IRLED1WriteP1;       // infrared transmitters
const int irLedRight = IRLED2WriteP1;
const int irReceiverLeft = IRReceiver1ReadP1;  // infrared receivers
const int irReceiverRight = IRReceiver2ReadP1;
const int dhtPin = DHT22ReadP1;           // humidity and temperature sensor
const int alarmLed = LED1WriteP1;         // LED and buzzer

const int humidityLimit = 700;     // in tenths of a percent
const int temperatureLimit = 300;  // in tenths of a degree
const int readEvery = 100;         // turns of the main loop between two readings

int humidity = 0;
int temperature = 0;
int lastTurn = 0;
char line[40];

// True when the receiver sees the transmitter's light thrown back
bool obstacleSeen(int transmitter, int receiver) {
  freqout(transmitter, 1, 38000);
  return input(receiver) == 0;
}

void drive(int left, int right) {
  servo_speed(leftServo, left);
  servo_speed(rightServo, -right);
}

// Stop, turn away from the obstacle and remember to which side
void avoid(bool left, bool right) {
  drive(0, 0);
  pause(200);
  if (left && right)
    lastTurn = -lastTurn;
  else
    lastTurn = left ? 1 : -1;
  if (lastTurn == 0)
    lastTurn = 1;
  drive(CRUISE * lastTurn, -CRUISE * lastTurn);
  pause(TURN_MS);
  drive(CRUISE, CRUISE);
}

void readAir(void) {
  int before = temperature;
  dht22_read(dhtPin);
  temperature = dht22_getTemp(CELSIUS);
  humidity = dht22_getHumidity();
  if (abs(temperature - before) > 5) {
    sprintf(line, "T %d H %d\n", temperature, humidity);
    print(line);
  }
  if (humidity > humidityLimit || temperature > temperatureLimit)
    high(alarmLed);
  else
    low(alarmLed);
}

int turns = 0;

void setup() {
  pause(500);                // let the sensor settle
  drive(CRUISE, CRUISE);

}

void loop() {
  bool left = obstacleSeen(irLedLeft, irReceiverLeft);
  bool right = obstacleSeen(irLedRight, irReceiverRight);
  if (left || right)
    avoid(left, right);

  turns++;
  if (turns >= readEvery) {
    turns = 0;
    readAir();
  }
  pause(20);
}
