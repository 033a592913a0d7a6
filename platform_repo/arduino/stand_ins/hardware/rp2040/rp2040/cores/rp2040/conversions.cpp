// Numbers to text, and random numbers.
#include <Arduino.h>

extern "C" char *ultoa(unsigned long value, char *text, int base) {
  char reversed[8 * sizeof value], *at = text;
  int digits = 0;
  do {
    int digit = value % base;
    reversed[digits++] = digit < 10 ? '0' + digit : 'a' + digit - 10;
  } while (value /= base);
  while (digits) *at++ = reversed[--digits];
  *at = 0;
  return text;
}

extern "C" char *ltoa(long value, char *text, int base) {
  if (value >= 0 || base != 10) return ultoa(value, text, base);
  text[0] = '-';
  ultoa(0UL - (unsigned long)value, text + 1, base);
  return text;
}

extern "C" char *dtostrf(double value, signed char width, unsigned char precision, char *text) {
  sprintf(text, "%*.*f", (int)width, (int)precision, value);
  return text;
}

void randomSeed(unsigned long seed) {
  if (seed) srand(seed);
}
long random(long below) { return below > 0 ? rand() % below : 0; }
long random(long from, long below) { return from < below ? from + random(below - from) : from; }

uint16_t makeWord(uint16_t word) { return word; }
uint16_t makeWord(uint8_t high, uint8_t low) { return high << 8 | low; }
