#pragma once
#include <Arduino.h>

class Wheel {
public:
  Wheel(byte pin, int speed = 100);
  void turn();
  void turn(int speed);
  int turns() const { return _turns; }
private:
  byte _pin;
  int _speed, _turns = 0;
};
