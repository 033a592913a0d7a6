/* ArduinoCore-avr 1.8.6, WCharacter.h: names and signatures. */
#pragma once
bool isAlphaNumeric(int c);
bool isAlpha(int c);
bool isAscii(int c);
bool isWhitespace(int c);
bool isControl(int c);
bool isDigit(int c);
bool isGraph(int c);
bool isLowerCase(int c);
bool isPrintable(int c);
bool isPunct(int c);
bool isSpace(int c);
bool isUpperCase(int c);
bool isHexadecimalDigit(int c);
int toAscii(int c);
int toLowerCase(int c);
int toUpperCase(int c);
