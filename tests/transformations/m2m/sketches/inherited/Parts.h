#pragma once
#include <Arduino.h>

class Light {
public:
  Light(int pin);
  void on();

protected:
  int pin;
};

class Lamp : public Light {
public:
  Lamp(int pin) : Light(pin), level(0) {}
  void dim(int value);

private:
  int level;
};

class Sensor {
public:
  Sensor(int pin);
  int value();

private:
  int channel;
};

class Robot {
public:
  Robot(Lamp* front, Sensor& eye) : front(front), eye(eye) {}
  void go();

private:
  Lamp* front;
  Sensor& eye;
};
