/* Environmental monitoring on the Propeller Activity Board: the robot drives on its own, two pairs of infrared
   transmitters and receivers find obstacles, a DHT22 is read from time to time, and a LED with a buzzer tells when
   the air is too damp or too warm. */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include "simpletools.h"
#include "servo.h"
#include "dht22.h"

#define CRUISE 60               // servo speed when nothing is in the way
#define TURN_MS 600             // a turn of about 90 degrees

const int leftServo = 12;       // servos, continuous rotation
const int rightServo = 13;
const int irLedLeft = 11;       // infrared transmitters
const int irLedRight = 1;
const int irReceiverLeft = 10;  // infrared receivers
const int irReceiverRight = 2;
const int dhtPin = 5;           // humidity and temperature sensor
const int alarmLed = 9;         // LED and buzzer

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

int main() {
  int turns = 0;
  pause(500);                // let the sensor settle
  drive(CRUISE, CRUISE);

  while (1) {
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
}
