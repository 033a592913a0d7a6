/* Library SoftwareSerial of ArduinoCore-avr 1.8.6: names and signatures. */
#pragma once
#include "Stream.h"
class SoftwareSerial : public Stream {
public:
  SoftwareSerial(uint8_t receivePin, uint8_t transmitPin, bool inverse_logic = false);
  ~SoftwareSerial();
  void begin(long speed);
  bool listen();
  void end();
  bool isListening();
  bool stopListening();
  bool overflow();
  int peek();
  virtual size_t write(uint8_t byte);
  virtual int read();
  virtual int available();
  virtual void flush();
  operator bool();
  using Print::write;
};
