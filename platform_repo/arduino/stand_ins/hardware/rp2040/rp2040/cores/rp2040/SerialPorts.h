// The console on USB and the two lines of the chip.
#pragma once
#include "HardwareSerial.h"

class SerialUSB : public HardwareSerial {
 public:
  void begin(unsigned long baud = 115200) override;
  void begin(unsigned long baud, uint16_t) override { begin(baud); }
  void end() override {}
  operator bool() override;
  int available() override;
  int read() override;
  int peek() override;
  size_t write(uint8_t byte) override;
  size_t write(const uint8_t *bytes, size_t count) override;
  using Print::write;
  int availableForWrite() override;
  void flush() override;
  bool dtr() { return *this; }
};

class SerialUART : public HardwareSerial {
 public:
  SerialUART(int line, uint8_t tx, uint8_t rx) : line(line), tx(tx), rx(rx) {}
  bool setTX(uint8_t pin) { tx = pin; return true; }
  bool setRX(uint8_t pin) { rx = pin; return true; }
  bool setPinout(uint8_t txPin, uint8_t rxPin) { return setTX(txPin) && setRX(rxPin); }
  bool setFIFOSize(size_t) { return true; }
  void begin(unsigned long baud = 115200) override { begin(baud, SERIAL_8N1); }
  void begin(unsigned long baud, uint16_t config) override;
  void end() override;
  operator bool() override { return running; }
  int available() override;
  int read() override;
  int peek() override;
  size_t write(uint8_t byte) override;
  using Print::write;
  int availableForWrite() override;
  void flush() override;
  void take();  // what has come, from the line to the buffer

 private:
  int line;
  uint8_t tx, rx;
  bool running = false;
  uint8_t buffer[256];
  volatile uint8_t first = 0, last = 0;  // they wrap with the buffer
};

extern SerialUSB Serial;
extern SerialUART Serial1, Serial2;
