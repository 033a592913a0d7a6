// Conversions of numbers that avr-libc has beside the C standard.
#pragma once
#ifdef __cplusplus
extern "C" {
#endif
char *itoa(int value, char *text, int base);
char *utoa(unsigned value, char *text, int base);
char *ltoa(long value, char *text, int base);
char *ultoa(unsigned long value, char *text, int base);
char *dtostrf(double value, signed char width, unsigned char precision, char *text);
#ifdef __cplusplus
}
#endif
