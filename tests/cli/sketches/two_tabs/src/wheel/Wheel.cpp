#include "Wheel.h"

Wheel::Wheel(byte pin, int speed) : _pin(pin), _speed(speed) { pinMode(_pin, OUTPUT); }
void Wheel::turn() { turn(_speed); }
void Wheel::turn(int speed) {
  analogWrite(_pin, speed);
  _turns++;
}
