#include <Arduino.h>
#include "Wheel.h"

Wheel::Wheel(int pin, int lamp) : pin_(pin), lamp_(lamp) {}

void Wheel::begin() {
  pinMode(pin_, OUTPUT);
  pinMode(lamp_, OUTPUT);
}

void Wheel::go() {
  digitalWrite(pin_, HIGH);
}
