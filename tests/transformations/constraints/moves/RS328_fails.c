#include "simpletools.h"
static void flash(int pin) { high(pin); low(pin); }

int main(void)
{
  void (*act)(int) = high;  // RS328: high
  if (input(3)) act = flash;
  act(4);
}
