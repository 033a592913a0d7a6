#pragma once
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

class __FlashStringHelper;
#define FPSTR(text) (reinterpret_cast<const __FlashStringHelper *>(text))
#define F(text) (FPSTR(text))

class String {
 public:
  String(const char *text = "") { assign(text, text ? strlen(text) : 0); }
  String(const char *text, unsigned length) { assign(text, length); }
  String(const String &other) { assign(other.letters, other.count); }
  String(String &&other) noexcept : letters(other.letters), count(other.count), room(other.room) { other.letters = nullptr, other.count = other.room = 0; }
  String(const __FlashStringHelper *text) : String((const char *)text) {}
  explicit String(char letter) { assign(&letter, 1); }
  explicit String(unsigned char value, unsigned char base = 10) : String((unsigned long)value, base) {}
  explicit String(int value, unsigned char base = 10) : String((long)value, base) {}
  explicit String(unsigned value, unsigned char base = 10) : String((unsigned long)value, base) {}
  explicit String(long value, unsigned char base = 10);
  explicit String(unsigned long value, unsigned char base = 10);
  explicit String(float value, unsigned char places = 2) : String((double)value, places) {}
  explicit String(double value, unsigned char places = 2);
  ~String() { free(letters); }

  String &operator=(const String &other);
  String &operator=(String &&other) noexcept;
  String &operator=(const char *text) { return assign(text, text ? strlen(text) : 0); }
  String &operator=(const __FlashStringHelper *text) { return *this = (const char *)text; }
  bool reserve(unsigned size);
  unsigned length() const { return count; }
  bool isEmpty() const { return !count; }
  explicit operator bool() const { return letters; }
  const char *c_str() const { return letters ? letters : ""; }
  char *begin() { return letters; }
  char *end() { return letters + count; }
  const char *begin() const { return c_str(); }
  const char *end() const { return c_str() + count; }

  bool concat(const char *text, unsigned length);
  bool concat(const String &text) { return concat(text.c_str(), text.count); }
  bool concat(const char *text) { return text && concat(text, strlen(text)); }
  bool concat(const __FlashStringHelper *text) { return concat((const char *)text); }
  bool concat(char letter) { return concat(&letter, 1); }
  template <class Value> bool concat(Value value) { return concat(String(value)); }
  template <class Value> String &operator+=(const Value &value) {
    concat(value);
    return *this;
  }
  template <class Value> friend String operator+(const String &left, const Value &right) {
    String sum(left);
    sum.concat(right);
    return sum;
  }
  friend String operator+(const char *left, const String &right) { return String(left) + right; }

  int compareTo(const String &other) const { return strcmp(c_str(), other.c_str()); }
  bool equals(const String &other) const { return count == other.count && !compareTo(other); }
  bool equals(const char *other) const { return !strcmp(c_str(), other ? other : ""); }
  bool equalsIgnoreCase(const String &other) const { return !strcasecmp(c_str(), other.c_str()); }
  bool operator==(const String &other) const { return equals(other); }
  bool operator==(const char *other) const { return equals(other); }
  bool operator!=(const String &other) const { return !equals(other); }
  bool operator!=(const char *other) const { return !equals(other); }
  bool operator<(const String &other) const { return compareTo(other) < 0; }
  bool operator>(const String &other) const { return compareTo(other) > 0; }
  bool operator<=(const String &other) const { return compareTo(other) <= 0; }
  bool operator>=(const String &other) const { return compareTo(other) >= 0; }
  bool startsWith(const String &text) const { return startsWith(text, 0); }
  bool startsWith(const String &text, unsigned at) const;
  bool endsWith(const String &text) const { return count >= text.count && startsWith(text, count - text.count); }

  char charAt(unsigned at) const { return at < count ? letters[at] : 0; }
  void setCharAt(unsigned at, char letter) {
    if (at < count) letters[at] = letter;
  }
  char operator[](unsigned at) const { return charAt(at); }
  char &operator[](unsigned at);
  void toCharArray(char *to, unsigned size, unsigned from = 0) const;
  void getBytes(unsigned char *to, unsigned size, unsigned from = 0) const { toCharArray((char *)to, size, from); }
  int indexOf(char letter, unsigned from = 0) const;
  int indexOf(const String &text, unsigned from = 0) const;
  int lastIndexOf(char letter) const { return lastIndexOf(letter, count ? count - 1 : 0); }
  int lastIndexOf(char letter, unsigned from) const;
  int lastIndexOf(const String &text) const;
  String substring(unsigned from) const { return substring(from, count); }
  String substring(unsigned from, unsigned to) const;
  void replace(char from, char to);
  void replace(const String &from, const String &to);
  void remove(unsigned at) { remove(at, count); }
  void remove(unsigned at, unsigned length);
  void toLowerCase();
  void toUpperCase();
  void trim();
  long toInt() const { return atol(c_str()); }
  float toFloat() const { return (float)toDouble(); }
  double toDouble() const { return atof(c_str()); }

 private:
  char *letters = nullptr;
  unsigned count = 0, room = 0;
  String &assign(const char *text, unsigned length);
};
class StringSumHelper : public String {  // a type of its own: libraries specialise templates for both
 public:
  using String::String;
  StringSumHelper(const String &text) : String(text) {}
};
