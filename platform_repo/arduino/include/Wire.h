/* Library Wire of ArduinoCore-avr 1.8.6: names and signatures. */
#pragma once
#include "Stream.h"
#define BUFFER_LENGTH 32
#define WIRE_HAS_END 1
#define WIRE_HAS_TIMEOUT 1
class TwoWire : public Stream {
public:
  TwoWire();
  void begin();
  void begin(uint8_t address);
  void begin(int address);
  void end();
  void setClock(uint32_t frequency);
  void setWireTimeout(uint32_t timeout = 25000, bool reset_with_timeout = false);
  bool getWireTimeoutFlag(void);
  void clearWireTimeoutFlag(void);
  void beginTransmission(uint8_t address);
  void beginTransmission(int address);
  uint8_t endTransmission(void);
  uint8_t endTransmission(uint8_t sendStop);
  uint8_t requestFrom(uint8_t address, uint8_t quantity);
  uint8_t requestFrom(uint8_t address, uint8_t quantity, uint8_t sendStop);
  uint8_t requestFrom(uint8_t address, uint8_t quantity, uint32_t iaddress, uint8_t isize, uint8_t sendStop);
  uint8_t requestFrom(int address, int quantity);
  uint8_t requestFrom(int address, int quantity, int sendStop);
  virtual size_t write(uint8_t data);
  virtual size_t write(const uint8_t *data, size_t quantity);
  virtual int available(void);
  virtual int read(void);
  virtual int peek(void);
  virtual void flush(void);
  void onReceive(void (*function)(int));
  void onRequest(void (*function)(void));
  size_t write(unsigned long n);
  size_t write(long n);
  size_t write(unsigned int n);
  size_t write(int n);
  using Print::write;
};
extern TwoWire Wire;
