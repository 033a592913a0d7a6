#include "simpletools.h"
static void flash(void) { high(5); low(5); }

int main(void)
{
  void (*act)(int) = high;
  void (*other)(void) = flash;
  if (input(3)) act = low;
  act(4);
  other();
}
