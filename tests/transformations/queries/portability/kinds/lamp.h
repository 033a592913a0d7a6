#pragma once
#include <Arduino.h>

class Lamp {
public:
  Lamp(int pin) : _pin(pin) { pinMode(_pin, OUTPUT); }
  void tone(int level) { analogWrite(_pin, level); }
private:
  int _pin;
};
