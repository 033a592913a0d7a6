#include "simpletools.h"
int main() { int pin = getChar() - '0'; high(pin); high(26); }
