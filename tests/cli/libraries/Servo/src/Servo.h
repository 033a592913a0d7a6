#pragma once
class Servo {
public:
  int attach(int pin);
  void writeMicroseconds(int value);
};
