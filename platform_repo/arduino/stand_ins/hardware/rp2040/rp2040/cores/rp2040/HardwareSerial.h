#pragma once
#include "Stream.h"

#define SERIAL_8N1 0x413UL
#define SERIAL_8E1 0x411UL
#define SERIAL_8O1 0x412UL
#define SERIAL_8N2 0x433UL
#define SERIAL_7E1 0x311UL
#define SERIAL_7O1 0x312UL

class HardwareSerial : public Stream {
 public:
  virtual void begin(unsigned long baud) = 0;
  virtual void begin(unsigned long baud, uint16_t config) = 0;
  virtual void end() = 0;
  virtual operator bool() = 0;
  using Print::write;
};
void serialEventRun() __attribute__((weak));
void serialEvent1Run() __attribute__((weak));  // there if the program uses one of the two lines
