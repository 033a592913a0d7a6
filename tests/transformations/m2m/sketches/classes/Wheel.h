#pragma once

class Wheel {
public:
  Wheel(int pin, int lamp = 7);
  void begin();
  void go();

private:
  int pin_;
  int lamp_;
};
