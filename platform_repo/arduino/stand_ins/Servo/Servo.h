// Stand-in with the API of the Arduino library Servo 1.2, on Timer1. Own code.
#ifndef Servo_h
#define Servo_h

#include <Arduino.h>

#define MIN_PULSE_WIDTH 544       // microseconds, at 0 degrees
#define MAX_PULSE_WIDTH 2400      // microseconds, at 180 degrees
#define DEFAULT_PULSE_WIDTH 1500  // microseconds, until something is written
#define REFRESH_INTERVAL 20000    // microseconds from frame to frame
#define MAX_SERVOS 12
#define INVALID_SERVO 255

class Servo {
 public:
  Servo();
  uint8_t attach(int pin);  // returns the channel, INVALID_SERVO if there is none left
  uint8_t attach(int pin, int min, int max);
  void detach();
  void write(int value);  // degrees; from MIN_PULSE_WIDTH on microseconds
  void writeMicroseconds(int value);
  int read();  // degrees
  int readMicroseconds();
  bool attached();

 private:
  uint8_t channel;
  int lowest;
  int highest;
};

#endif
