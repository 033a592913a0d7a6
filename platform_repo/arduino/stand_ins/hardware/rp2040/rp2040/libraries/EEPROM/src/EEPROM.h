// A page of flash as an EEPROM: begin with its size, and commit what was written.
#pragma once
#include <Arduino.h>

class EEPROMClass {
 public:
  void begin(size_t size);
  bool commit();
  bool end() { return commit(); }
  uint8_t read(int address) const { return address >= 0 && (size_t)address < size ? data[address] : 0; }
  void write(int address, uint8_t value) {
    if (address >= 0 && (size_t)address < size) data[address] = value;
  }
  void update(int address, uint8_t value) { write(address, value); }
  size_t length() const { return size; }
  uint8_t &operator[](int address);
  uint8_t operator[](int address) const { return read(address); }
  template <class Value> Value &get(int address, Value &value) {
    if (address >= 0 && address + sizeof(Value) <= size) memcpy((void *)&value, data + address, sizeof(Value));
    return value;
  }
  template <class Value> const Value &put(int address, const Value &value) {
    if (address >= 0 && address + sizeof(Value) <= size) memcpy(data + address, (const void *)&value, sizeof(Value));
    return value;
  }

 private:
  uint8_t *data = nullptr;
  size_t size = 0;
};

extern EEPROMClass EEPROM;
