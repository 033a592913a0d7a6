// The first master of SPI; data are sent and received byte by byte.
#pragma once
#include <Arduino.h>

#define SPI_MODE0 0
#define SPI_MODE1 1
#define SPI_MODE2 2
#define SPI_MODE3 3
#define SPI_HAS_TRANSACTION 1

struct SPISettings {
  uint32_t hertz;
  BitOrder order;
  uint8_t mode;
  SPISettings(uint32_t hertz = 1000000, BitOrder order = MSBFIRST, uint8_t mode = SPI_MODE0) : hertz(hertz), order(order), mode(mode) {}
};

class SPIClass {
 public:
  bool setRX(pin_size_t pin) { rx = pin; return true; }
  bool setTX(pin_size_t pin) { tx = pin; return true; }
  bool setSCK(pin_size_t pin) { sck = pin; return true; }
  bool setCS(pin_size_t pin) { cs = pin; return true; }
  void begin(bool ownSelect = false);
  void end();
  void beginTransaction(SPISettings settings);
  void endTransaction() {}
  void setBitOrder(BitOrder order) { beginTransaction(SPISettings(current.hertz, order, current.mode)); }
  void setDataMode(uint8_t mode) { beginTransaction(SPISettings(current.hertz, current.order, mode)); }
  void setClockDivider(uint32_t divider) { beginTransaction(SPISettings(F_CPU / divider, current.order, current.mode)); }
  void usingInterrupt(int) {}
  uint8_t transfer(uint8_t byte);
  uint16_t transfer16(uint16_t value);
  void transfer(void *bytes, size_t count);
  void transfer(const void *sent, void *received, size_t count);  // either may be null

 private:
  pin_size_t rx = PIN_SPI0_MISO, tx = PIN_SPI0_MOSI, sck = PIN_SPI0_SCK, cs = PIN_SPI0_SS;
  SPISettings current;
};

extern SPIClass SPI;
