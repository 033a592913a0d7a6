// Up to eight servos. Limits as in arduino-pico: 1000 to 2000 us unless attach is given others, and writeMicroseconds obeys them.
#pragma once
#include <Arduino.h>

#define DEFAULT_MIN_PULSE_WIDTH 1000
#define DEFAULT_MAX_PULSE_WIDTH 2000
#define DEFAULT_NEUTRAL_PULSE_WIDTH 1500
#define REFRESH_INTERVAL 20000
#define MAX_SERVOS 8
#define INVALID_SERVO 255

class Servo {
 public:
  ~Servo() { detach(); }
  uint8_t attach(pin_size_t pin, int value = DEFAULT_NEUTRAL_PULSE_WIDTH) {
    return attach(pin, DEFAULT_MIN_PULSE_WIDTH, DEFAULT_MAX_PULSE_WIDTH, value);
  }
  uint8_t attach(pin_size_t pin, int min, int max, int value = DEFAULT_NEUTRAL_PULSE_WIDTH);
  void detach();
  void write(int value);  // degrees; from 200 on microseconds
  void writeMicroseconds(int value);
  int read();  // degrees
  int readMicroseconds() { return width; }
  bool attached() { return place >= 0; }

 private:
  int place = -1, width = DEFAULT_NEUTRAL_PULSE_WIDTH, lowest = DEFAULT_MIN_PULSE_WIDTH, highest = DEFAULT_MAX_PULSE_WIDTH;
};
