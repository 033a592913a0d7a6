/* Formatted text with the machine's own double: what a variadic function receives as double is of 8 bytes here, and of 4 there. */
#include <stdio.h>
#include <string.h>
#include "host.h"

/* Takes the sign of values that are no numbers, which the source's library does not print. Values lie one behind the other here. */
static void drop_nan_signs(const char *format, va_list values) {
  char *at = (char *)values;
  while ((format = strchr(format, '%'))) {
    int wide = 0;
    for (format++; *format && strchr("-+ #'0123456789.*hlLqjzt", *format); format++) {
      if (*format == '*') at += sizeof(int);
      wide += *format == 'l' ? 1 : *format == 'q' || *format == 'j' ? 2 : 0;
    }
    if (!*format) return;
    if (strchr("aAeEfFgG", *format)) {
      double value;
      memcpy(&value, at, sizeof value);
      if (value != value) at[sizeof value - 1] &= 0x7F;
      at += sizeof value;
    } else if (*format != '%')
      at += wide > 1 ? sizeof(long long) : sizeof(int);
    format++;
  }
}

int host_print(char *text, int size, const char *format, va_list values) {
  drop_nan_signs(format, values);
  return vsnprintf(text, size, format, values);
}

/* The same format without the `l` before e, f and g: a double of the program has 4 bytes. */
int host_scan(const char *text, const char *format, va_list places) {
  char plain[512];
  unsigned length = 0;
  for (const char *at = format; *at && length < sizeof plain - 1; at++) {
    if (*at == 'l' && strchr("eEfFgG", at[1]) && at[1]) continue;
    plain[length++] = *at;
  }
  plain[length] = 0;
  return vsscanf(text, plain, places);
}

int host_double_bits(va_list *values) {
  float value = (float)va_arg(*values, double);
  int bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}
