/* ArduinoCore-avr 1.8.6, Print.h: names and signatures. */
#pragma once
#include <stdio.h>
#include "WString.h"
#include "Printable.h"
#define DEC 10
#define HEX 16
#define OCT 8
#define BIN 2
class Print {
public:
  int getWriteError();
  void clearWriteError();
  virtual size_t write(uint8_t value) = 0;
  size_t write(const char *str);
  virtual size_t write(const uint8_t *buffer, size_t size);
  size_t write(const char *buffer, size_t size);
  virtual int availableForWrite();
  virtual void flush();
  size_t print(const __FlashStringHelper *text);
  size_t print(const String &text);
  size_t print(const char *text);
  size_t print(char c);
  size_t print(unsigned char value, int base = DEC);
  size_t print(int value, int base = DEC);
  size_t print(unsigned int value, int base = DEC);
  size_t print(long value, int base = DEC);
  size_t print(unsigned long value, int base = DEC);
  size_t print(double value, int places = 2);
  size_t print(const Printable &thing);
  size_t println(const __FlashStringHelper *text);
  size_t println(const String &text);
  size_t println(const char *text);
  size_t println(char c);
  size_t println(unsigned char value, int base = DEC);
  size_t println(int value, int base = DEC);
  size_t println(unsigned int value, int base = DEC);
  size_t println(long value, int base = DEC);
  size_t println(unsigned long value, int base = DEC);
  size_t println(double value, int places = 2);
  size_t println(const Printable &thing);
  size_t println(void);
};
