#include "Parts.h"

Light::Light(int pin) {
  this->pin = pin;
  pinMode(pin, OUTPUT);
}

void Light::on() {
  digitalWrite(pin, HIGH);
}

void Lamp::dim(int value) {
  level = value;
  analogWrite(pin, level);
}

Sensor::Sensor(int pin) {
  channel = pin;
}

int Sensor::value() {
  return analogRead(channel);
}

void Robot::go() {
  front->dim(eye.value() / 4);
}
