#include "simpletools.h"

void blink(int pin)
{
  high(pin);
}
