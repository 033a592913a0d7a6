#include "Print.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

size_t Print::write(const uint8_t *bytes, size_t count) {
  size_t written = 0;
  while (written < count && write(bytes[written])) written++;
  return written;
}

size_t Print::print(unsigned long long value, int base) {
  char text[8 * sizeof value + 1], *at = text + sizeof text - 1;
  if (base < 2) base = DEC;
  *at = 0;
  do {
    int digit = value % base;
    *--at = digit < 10 ? '0' + digit : 'A' + digit - 10;
  } while (value /= base);
  return write(at);
}

size_t Print::print(long long value, int base) {
  if (value >= 0 || base != DEC) return print((unsigned long long)value, base);
  size_t count = write((uint8_t)'-');
  return count + print(0ULL - (unsigned long long)value, base);
}

size_t Print::print(long value, int base) {  // bases other than ten show the 32 bits of a negative number
  return base == DEC ? print((long long)value, base) : print((unsigned long long)(unsigned long)value, base);
}

size_t Print::print(double value, int places) {
  if (isnan(value)) return print("nan");
  if (isinf(value)) return print("inf");
  if (value > 4294967040.0 || value < -4294967040.0) return print("ovf");
  size_t count = 0;
  if (value < 0) {
    count += write((uint8_t)'-');
    value = -value;
  }
  double half = 0.5;
  for (int place = 0; place < places; place++) half /= 10;
  value += half;
  unsigned long whole = (unsigned long)value;
  count += print(whole);
  if (places > 0) count += write((uint8_t)'.');
  for (double rest = value - whole; places-- > 0;) {
    rest *= 10;
    unsigned digit = (unsigned)rest;
    count += print(digit);
    rest -= digit;
  }
  return count;
}

static size_t formatted(Print &to, const char *format, va_list values) {
  char text[128];
  va_list again;
  va_copy(again, values);
  int length = vsnprintf(text, sizeof text, format, values);
  size_t count = 0;
  if (length >= (int)sizeof text) {
    if (char *longer = (char *)malloc(length + 1)) {
      vsnprintf(longer, length + 1, format, again);
      count = to.write((const uint8_t *)longer, length);
      free(longer);
    }
  } else if (length > 0) {
    count = to.write((const uint8_t *)text, length);
  }
  va_end(again);
  return count;
}

size_t Print::printf(const char *format, ...) {
  va_list values;
  va_start(values, format);
  size_t count = formatted(*this, format, values);
  va_end(values);
  return count;
}

size_t Print::printf_P(const char *format, ...) {
  va_list values;
  va_start(values, format);
  size_t count = formatted(*this, format, values);
  va_end(values);
  return count;
}
