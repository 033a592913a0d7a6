#include "WString.h"

#include <ctype.h>
#include <stdio.h>

#include "stdlib_noniso.h"

String::String(long value, unsigned char base) {
  char text[8 * sizeof value + 2];
  *this = ltoa(value, text, base);
}

String::String(unsigned long value, unsigned char base) {
  char text[8 * sizeof value + 1];
  *this = ultoa(value, text, base);
}

String::String(double value, unsigned char places) {
  char text[64];
  snprintf(text, sizeof text, "%.*f", places, value);
  *this = text;
}

bool String::reserve(unsigned size) {
  if (letters && room >= size) return true;
  char *more = (char *)realloc(letters, size + 1);
  if (!more) return false;
  if (!letters) *more = 0;
  letters = more;
  room = size;
  return true;
}

String &String::assign(const char *text, unsigned length) {
  if (!reserve(length)) return *this;
  if (length) memmove(letters, text, length);
  letters[count = length] = 0;
  return *this;
}

String &String::operator=(const String &other) { return this == &other ? *this : assign(other.c_str(), other.count); }

String &String::operator=(String &&other) noexcept {
  if (this == &other) return *this;
  free(letters);
  letters = other.letters, count = other.count, room = other.room;
  other.letters = nullptr, other.count = other.room = 0;
  return *this;
}

bool String::concat(const char *text, unsigned length) {
  if (!text) return false;
  bool own = letters && text >= letters && text <= letters + count;
  unsigned at = own ? text - letters : 0;
  if (!reserve(count + length)) return false;
  memmove(letters + count, own ? letters + at : text, length);
  letters[count += length] = 0;
  return true;
}

bool String::startsWith(const String &text, unsigned at) const {
  return at <= count && count - at >= text.count && !strncmp(c_str() + at, text.c_str(), text.count);
}

char &String::operator[](unsigned at) {
  static char none;
  none = 0;
  return at < count ? letters[at] : none;
}

void String::toCharArray(char *to, unsigned size, unsigned from) const {
  if (!size || !to) return;
  unsigned length = from < count ? count - from : 0;
  if (length > size - 1) length = size - 1;
  memcpy(to, c_str() + (length ? from : 0), length);
  to[length] = 0;
}

int String::indexOf(char letter, unsigned from) const {
  const char *found = from < count ? strchr(letters + from, letter) : nullptr;
  return found ? found - letters : -1;
}

int String::indexOf(const String &text, unsigned from) const {
  const char *found = from < count ? strstr(letters + from, text.c_str()) : nullptr;
  return found ? found - letters : -1;
}

int String::lastIndexOf(char letter, unsigned from) const {
  for (int at = from < count ? (int)from : (int)count - 1; at >= 0; at--)
    if (letters[at] == letter) return at;
  return -1;
}

int String::lastIndexOf(const String &text) const {
  for (int at = (int)count - (int)text.count; at >= 0; at--)
    if (startsWith(text, at)) return at;
  return -1;
}

String String::substring(unsigned from, unsigned to) const {
  if (from > to) {
    unsigned other = from;
    from = to, to = other;
  }
  if (to > count) to = count;
  return from < to ? String(letters + from, to - from) : String();
}

void String::replace(char from, char to) {
  for (unsigned at = 0; at < count; at++)
    if (letters[at] == from) letters[at] = to;
}

void String::replace(const String &from, const String &to) {
  if (!from.count) return;
  String made;
  unsigned at = 0;
  for (int found; (found = indexOf(from, at)) >= 0; at = found + from.count) {
    made.concat(letters + at, found - at);
    made.concat(to);
  }
  made.concat(c_str() + at, count - at);
  *this = made;
}

void String::remove(unsigned at, unsigned length) {
  if (at >= count || !length) return;
  if (length > count - at) length = count - at;
  memmove(letters + at, letters + at + length, count - at - length);
  letters[count -= length] = 0;
}

void String::toLowerCase() {
  for (unsigned at = 0; at < count; at++) letters[at] = tolower((unsigned char)letters[at]);
}

void String::toUpperCase() {
  for (unsigned at = 0; at < count; at++) letters[at] = toupper((unsigned char)letters[at]);
}

void String::trim() {
  unsigned from = 0, to = count;
  while (from < to && isspace((unsigned char)letters[from])) from++;
  while (to > from && isspace((unsigned char)letters[to - 1])) to--;
  *this = substring(from, to);
}
