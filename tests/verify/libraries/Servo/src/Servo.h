#pragma once
#include <Helper.h>
#include <inttypes.h>

class Servo {
 public:
  uint8_t attach(int pin) { return help(pin); }
  uint8_t attach(int pin, int, int) { return help(pin); }
  void detach() {}
  void write(int) {}
  void writeMicroseconds(int) {}
  int read() { return 0; }
  int readMicroseconds() { return 0; }
  bool attached() { return true; }
};
