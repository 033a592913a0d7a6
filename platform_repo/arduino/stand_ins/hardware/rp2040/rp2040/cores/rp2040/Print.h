#pragma once
#include <stdint.h>
#include <string.h>

#include "Printable.h"
#include "WString.h"

#define DEC 10
#define HEX 16
#define OCT 8
#define BIN 2

class Print {
 public:
  virtual ~Print() {}
  virtual size_t write(uint8_t byte) = 0;
  virtual size_t write(const uint8_t *bytes, size_t count);
  virtual int availableForWrite() { return 0; }
  virtual void flush() {}
  size_t write(const char *text) { return text ? write((const uint8_t *)text, strlen(text)) : 0; }
  size_t write(const char *text, size_t count) { return write((const uint8_t *)text, count); }
  int getWriteError() { return error; }
  void clearWriteError() { error = 0; }

  size_t print(const __FlashStringHelper *text) { return write((const char *)text); }
  size_t print(const String &text) { return write(text.c_str(), text.length()); }
  size_t print(const char *text) { return write(text); }
  size_t print(char letter) { return write((uint8_t)letter); }
  size_t print(unsigned char value, int base = DEC) { return print((unsigned long long)value, base); }
  size_t print(short value, int base = DEC) { return print((long)value, base); }
  size_t print(unsigned short value, int base = DEC) { return print((unsigned long)value, base); }
  size_t print(int value, int base = DEC) { return print((long)value, base); }
  size_t print(unsigned int value, int base = DEC) { return print((unsigned long long)value, base); }
  size_t print(long value, int base = DEC);
  size_t print(unsigned long value, int base = DEC) { return print((unsigned long long)value, base); }
  size_t print(long long value, int base = DEC);
  size_t print(unsigned long long value, int base = DEC);
  size_t print(double value, int places = 2);
  size_t print(const Printable &thing) { return thing.printTo(*this); }
  size_t println() { return write("\r\n"); }
  template <class Value> size_t println(const Value &value) {
    size_t count = print(value);
    return count + println();
  }
  template <class Value> size_t println(const Value &value, int baseOrPlaces) {
    size_t count = print(value, baseOrPlaces);
    return count + println();
  }
  size_t printf(const char *format, ...) __attribute__((format(printf, 2, 3)));
  size_t printf_P(const char *format, ...) __attribute__((format(printf, 2, 3)));

 protected:
  void setWriteError(int value = 1) { error = value; }

 private:
  int error = 0;
};
