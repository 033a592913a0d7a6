#include "simpletools.h"
int count;
#define high(pin) (count++, high((pin)))
#define input(pin) (input)(pin)
#define toggle low
int main(void) {
  high(3);
  if (input(4)) toggle(3);
#undef toggle
  toggle(5);
  while (1) pause(100);
}
