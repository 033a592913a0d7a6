// The master of the two-wire bus at the board's SDA and SCL.
#pragma once
#include <Arduino.h>

class TwoWire : public Stream {
 public:
  void begin() { runs = true; }
  void end() { runs = false; }
  void setClock(uint32_t frequency) { hertz = frequency; }
  void beginTransmission(int address);
  uint8_t endTransmission(bool stop = true);  // 0: done, 1: too long, 2: nobody there, 3: a byte was refused, 4: else
  size_t requestFrom(int address, int count, int stop = 1);
  using Print::write;
  size_t write(uint8_t byte) override;
  int available() override { return have - at; }
  int read() override { return at < have ? buffer[at++] : -1; }
  int peek() override { return at < have ? buffer[at] : -1; }

 private:
  static constexpr int ROOM = 256;
  uint32_t hertz = 100000;
  uint8_t buffer[ROOM];
  int have = 0, at = 0, target = 0;
  bool runs = false, tooLong = false;
  void passByte();
};
extern TwoWire Wire;
