#include "simpletools.h"

int main(void)
{
  int pin = getChar() - '0';
  unsigned mask = 0;
  high(pin);  // RS327: high(pin)
  mask |= 1 << pin;
  OUTA |= mask;  // RS327: OUTA
}
