// Servos with the limits that the library has on most cores: 544 to 2400 us unless attach is given others.
#pragma once
#include <Arduino.h>

#define MIN_PULSE_WIDTH 544
#define MAX_PULSE_WIDTH 2400
#define DEFAULT_PULSE_WIDTH 1500
#define REFRESH_INTERVAL 20000
#define INVALID_SERVO 255

class Servo {
 public:
  uint8_t attach(int pin) { return attach(pin, MIN_PULSE_WIDTH, MAX_PULSE_WIDTH); }
  uint8_t attach(int pin, int min, int max);
  void detach();
  void write(int value);  // degrees; from 544 on microseconds
  void writeMicroseconds(int value);
  int read() { return map(width + 1, lowest, highest, 0, 180); }  // degrees
  int readMicroseconds() { return width; }
  bool attached() { return place >= 0; }

 private:
  int place = -1, width = DEFAULT_PULSE_WIDTH, lowest = MIN_PULSE_WIDTH, highest = MAX_PULSE_WIDTH;
};
