/* Library EEPROM of ArduinoCore-avr 1.8.6: names and signatures. */
#pragma once
#include <stdint.h>
#include <avr/eeprom.h>
struct EERef {
  EERef(const int index);
  operator uint8_t() const;
  EERef &operator=(uint8_t in);
  EERef &update(uint8_t in);
};
struct EEPtr {
  EEPtr(const int index);
  operator int() const;
  EERef operator*();
  EEPtr &operator++();
};
struct EEPROMClass {
  EERef operator[](const int idx);
  uint8_t read(int idx);
  void write(int idx, uint8_t val);
  void update(int idx, uint8_t val);
  EEPtr begin();
  EEPtr end();
  uint16_t length();
  template <class T> T &get(int idx, T &t);
  template <class T> const T &put(int idx, const T &t);
};
extern EEPROMClass EEPROM;
