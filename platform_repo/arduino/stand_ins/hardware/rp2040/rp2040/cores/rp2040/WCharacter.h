#pragma once
#include <ctype.h>
inline bool isAlphaNumeric(int letter) { return isalnum(letter); }
inline bool isAlpha(int letter) { return isalpha(letter); }
inline bool isAscii(int letter) { return (unsigned)letter < 128; }
inline bool isWhitespace(int letter) { return isblank(letter); }
inline bool isControl(int letter) { return iscntrl(letter); }
inline bool isDigit(int letter) { return isdigit(letter); }
inline bool isGraph(int letter) { return isgraph(letter); }
inline bool isLowerCase(int letter) { return islower(letter); }
inline bool isPrintable(int letter) { return isprint(letter); }
inline bool isPunct(int letter) { return ispunct(letter); }
inline bool isSpace(int letter) { return isspace(letter); }
inline bool isUpperCase(int letter) { return isupper(letter); }
inline bool isHexadecimalDigit(int letter) { return isxdigit(letter); }
inline int toAscii(int letter) { return letter & 127; }
inline int toLowerCase(int letter) { return tolower(letter); }
inline int toUpperCase(int letter) { return toupper(letter); }
