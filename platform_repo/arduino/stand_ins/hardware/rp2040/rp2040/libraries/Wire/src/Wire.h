// The two masters of I2C. A slave compiles, and nobody ever calls it: begin(address) and its handlers do nothing.
#pragma once
#include <Arduino.h>

#define WIRE_BUFFER_SIZE 256

class TwoWire : public Stream {
 public:
  TwoWire(uint32_t base, pin_size_t sda, pin_size_t scl) : base(base), sda(sda), scl(scl) {}
  bool setSDA(pin_size_t pin) { sda = pin; return true; }
  bool setSCL(pin_size_t pin) { scl = pin; return true; }
  void begin();
  void begin(uint8_t) {}
  void begin(int) {}
  void onReceive(void (*)(int)) {}
  void onRequest(void (*)()) {}
  void end();
  void setClock(uint32_t hertz);
  void setTimeout(unsigned long milliseconds, bool = false) { Stream::setTimeout(milliseconds); }
  void beginTransmission(uint8_t address);
  uint8_t endTransmission(bool stop = true);  // 0: done, 1: too long, 2: nobody there, 3: a byte was refused, 4: else
  size_t requestFrom(uint8_t address, size_t count, bool stop = true);
  size_t requestFrom(int address, int count, int stop = 1) { return requestFrom((uint8_t)address, (size_t)count, stop != 0); }
  using Print::write;
  size_t write(uint8_t byte) override;
  size_t write(int value) { return write((uint8_t)value); }
  size_t write(unsigned value) { return write((uint8_t)value); }
  size_t write(long value) { return write((uint8_t)value); }
  size_t write(unsigned long value) { return write((uint8_t)value); }
  int available() override { return have - at; }
  int read() override { return at < have ? buffer[at++] : -1; }
  int peek() override { return at < have ? buffer[at] : -1; }

 private:
  uint32_t base;
  pin_size_t sda, scl;
  uint32_t hertz = 100000;
  uint8_t buffer[WIRE_BUFFER_SIZE];
  size_t have = 0, at = 0;
  uint8_t target = 0;
  bool running = false, held = false, tooLong = false;
  void aim(uint8_t address);
  bool wait(uint32_t flags);
  uint8_t aborted();
};

extern TwoWire Wire, Wire1;
