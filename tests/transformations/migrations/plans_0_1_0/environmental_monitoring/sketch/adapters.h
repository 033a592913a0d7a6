// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

const int32_t CELSIUS = 1;  // TODO: complete symbol

// int dht22_getHumidity()  [dht22.h]
// called in line 62
int32_t dht22_getHumidity() {
  // TODO: complete method
  return 0;
}

// int dht22_getTemp(char temp_units)  [dht22.h]
// called in line 61
int32_t dht22_getTemp(uint8_t temp_units) {
  // TODO: complete method
  (void)temp_units;
  return 0;
}

// char dht22_read(int dht_pin)  [dht22.h]
// called in line 60
// it blocks
uint8_t dht22_read(int32_t dht_pin) {
  // TODO: complete method
  (void)dht_pin;
  return 0;
}

// void freqout(int pin, int msTime, int frequency)  [simpletools.h]
// called in line 34
// it blocks
void freqout(int32_t pin, int32_t msTime, int32_t frequency) {
  // TODO: complete method
  (void)pin;
  (void)msTime;
  (void)frequency;
}

// void high(int pin)  [simpletools.h]
// called in line 68
void high(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// int input(int pin)  [simpletools.h]
// called in line 35
int32_t input(int32_t pin) {
  // TODO: complete method
  (void)pin;
  return 0;
}

// void low(int pin)  [simpletools.h]
// called in line 70
void low(int32_t pin) {
  // TODO: complete method
  (void)pin;
}

// void pause(int time)  [simpletools.h]
// called in lines 46, 54, 75, 89
// it blocks
void pause(int32_t time) {
  // TODO: complete method
  (void)time;
}

// int print(const char *format, ...)  [simpletext.h]
// called in line 65
int32_t print(const char *format, ...) {
  // TODO: complete method
  (void)format;
  return 0;
}

// int servo_speed(int pin, int speed)  [servo.h]
// called in lines 39, 40
// it starts code on another core there
int32_t servo_speed(int32_t pin, int32_t speed) {
  // TODO: complete method
  (void)pin;
  (void)speed;
  return 0;
}
