#include "simpletools.h"
const int lamp = 36;

int main(void)
{
  high(lamp);  // RS326: high(lamp)
  low(32);  // RS326: low(32)
  OUTA |= 1LL << 40;  // RS326: OUTA
  for (int pin = 30; pin < 34; pin++) toggle(pin);  // RS326: toggle(pin)
}
