/* ArduinoCore-avr 1.8.6, WString.h: names and signatures. */
#pragma once
#include <stddef.h>
#include <stdint.h>
class __FlashStringHelper;
#define F(string_literal) (reinterpret_cast<const __FlashStringHelper *>(string_literal))
class String {
public:
  String(const char *cstr = "");
  String(const String &str);
  String(const __FlashStringHelper *str);
  explicit String(char c);
  explicit String(unsigned char value, unsigned char base = 10);
  explicit String(int value, unsigned char base = 10);
  explicit String(unsigned int value, unsigned char base = 10);
  explicit String(long value, unsigned char base = 10);
  explicit String(unsigned long value, unsigned char base = 10);
  explicit String(float value, unsigned char decimalPlaces = 2);
  explicit String(double value, unsigned char decimalPlaces = 2);
  ~String();
  unsigned char reserve(unsigned int size);
  unsigned int length() const;
  String &operator=(const String &rhs);
  String &operator=(const char *cstr);
  String &operator=(const __FlashStringHelper *str);
  unsigned char concat(const String &str);
  unsigned char concat(const char *cstr);
  unsigned char concat(char c);
  unsigned char concat(unsigned char num);
  unsigned char concat(int num);
  unsigned char concat(unsigned int num);
  unsigned char concat(long num);
  unsigned char concat(unsigned long num);
  unsigned char concat(float num);
  unsigned char concat(double num);
  unsigned char concat(const __FlashStringHelper *str);
  template <class T> String &operator+=(const T &value);
  operator bool() const;
  int compareTo(const String &s) const;
  unsigned char equals(const String &s) const;
  unsigned char equals(const char *cstr) const;
  unsigned char operator==(const String &rhs) const;
  unsigned char operator==(const char *cstr) const;
  unsigned char operator!=(const String &rhs) const;
  unsigned char operator!=(const char *cstr) const;
  unsigned char operator<(const String &rhs) const;
  unsigned char operator>(const String &rhs) const;
  unsigned char operator<=(const String &rhs) const;
  unsigned char operator>=(const String &rhs) const;
  unsigned char equalsIgnoreCase(const String &s) const;
  unsigned char startsWith(const String &prefix) const;
  unsigned char startsWith(const String &prefix, unsigned int offset) const;
  unsigned char endsWith(const String &suffix) const;
  char charAt(unsigned int index) const;
  void setCharAt(unsigned int index, char c);
  char operator[](unsigned int index) const;
  char &operator[](unsigned int index);
  void getBytes(unsigned char *buf, unsigned int bufsize, unsigned int index = 0) const;
  void toCharArray(char *buf, unsigned int bufsize, unsigned int index = 0) const;
  const char *c_str() const;
  char *begin();
  char *end();
  int indexOf(char ch) const;
  int indexOf(char ch, unsigned int fromIndex) const;
  int indexOf(const String &str) const;
  int indexOf(const String &str, unsigned int fromIndex) const;
  int lastIndexOf(char ch) const;
  int lastIndexOf(char ch, unsigned int fromIndex) const;
  int lastIndexOf(const String &str) const;
  int lastIndexOf(const String &str, unsigned int fromIndex) const;
  String substring(unsigned int beginIndex) const;
  String substring(unsigned int beginIndex, unsigned int endIndex) const;
  void replace(char find, char replace);
  void replace(const String &find, const String &replace);
  void remove(unsigned int index);
  void remove(unsigned int index, unsigned int count);
  void toLowerCase();
  void toUpperCase();
  void trim();
  long toInt() const;
  float toFloat() const;
  double toDouble() const;
};
class StringSumHelper : public String {
public:
  template <class T> StringSumHelper(const T &value);
};
template <class T> StringSumHelper operator+(const String &lhs, const T &rhs);
StringSumHelper operator+(const char *lhs, const String &rhs);
StringSumHelper operator+(char lhs, const String &rhs);
StringSumHelper operator+(const __FlashStringHelper *lhs, const String &rhs);
