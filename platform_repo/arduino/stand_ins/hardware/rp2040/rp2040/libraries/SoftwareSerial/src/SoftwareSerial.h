// A serial line on any two pins, 8N1: bytes are sent with the clock watched, and received by the interrupt of their start bit.
#pragma once
#include <Arduino.h>

#define NOPIN 255

class SoftwareSerial : public HardwareSerial {
 public:
  SoftwareSerial(pin_size_t rx, pin_size_t tx, bool invert = false) : rx(rx), tx(tx), invertRx(invert), invertTx(invert) {}
  ~SoftwareSerial() { end(); }
  void setInverted(bool ofTx, bool ofRx) { invertTx = ofTx, invertRx = ofRx; }
  void begin(unsigned long baud = 115200) override;
  void begin(unsigned long baud, uint16_t) override { begin(baud); }
  void end() override;
  operator bool() override { return bit; }
  bool listen() { return true; }
  bool isListening() { return bit; }
  bool stopListening() { return true; }
  bool overflow();
  int available() override { return (uint8_t)(last - first); }
  int read() override;
  int peek() override { return available() ? buffer[first] : -1; }
  size_t write(uint8_t byte) override;
  using Print::write;
  void flush() override {}

 private:
  pin_size_t rx, tx;
  bool invertRx, invertTx, lost = false;
  uint32_t bit = 0;  // in 1/16 of a microsecond
  uint8_t buffer[256];
  volatile uint8_t first = 0, last = 0;
  void receive();
};
