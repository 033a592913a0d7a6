// Memory as an EEPROM; what is stored lasts as long as the run.
#pragma once
#include <Arduino.h>

class EEPROMClass {
 public:
  EEPROMClass() { memset(data, 255, sizeof data); }
  void begin(size_t = 0) {}
  bool commit() { return true; }
  void end() {}
  uint8_t read(int address) const { return data[(unsigned)address % sizeof data]; }
  void write(int address, uint8_t value) { data[(unsigned)address % sizeof data] = value; }
  void update(int address, uint8_t value) { write(address, value); }
  uint32_t length() const { return sizeof data; }
  template <class Value> Value &get(int address, Value &value) {
    for (size_t at = 0; at < sizeof value; at++) ((uint8_t *)&value)[at] = read(address + at);
    return value;
  }
  template <class Value> const Value &put(int address, const Value &value) {
    for (size_t at = 0; at < sizeof value; at++) write(address + at, ((const uint8_t *)&value)[at]);
    return value;
  }

 private:
  uint8_t data[4096];
};
static EEPROMClass EEPROM;
