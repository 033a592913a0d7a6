// The master of SPI: bytes by the levels of the board's pins, at most as fast as these change here.
#pragma once
#include <Arduino.h>

#define SPI_MODE0 0
#define SPI_MODE1 1
#define SPI_MODE2 2
#define SPI_MODE3 3

struct SPISettings {
  BitOrder order;
  uint8_t mode;
  SPISettings(uint32_t = 1000000, BitOrder order = MSBFIRST, uint8_t mode = SPI_MODE0) : order(order), mode(mode) {}
};

class SPIClass {
 public:
  void begin();
  void end() {}
  void beginTransaction(SPISettings settings) { current = settings; }
  void endTransaction() {}
  void setBitOrder(BitOrder order) { current.order = order; }
  void setDataMode(uint8_t mode) { current.mode = mode; }
  uint8_t transfer(uint8_t byte);

 private:
  SPISettings current;
};
extern SPIClass SPI;
