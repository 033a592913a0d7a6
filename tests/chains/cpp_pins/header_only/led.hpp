#pragma once
#include "simpletools.h"
class Led {
  int pin;
public:
  Led(int p) : pin(p) {}
  void on() { high(pin); }
};
