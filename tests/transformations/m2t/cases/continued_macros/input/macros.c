#include "simpletools.h"
#define PULSE(pin, t) do { \
    high(pin);            \
    pause(t);             \
    low(pin);             \
  } while (0)

int main()
{
#define TWICE(x) \
        PULSE(x, 1); \
        PULSE(x, 2)
  PULSE(3, 10);
  while (1) {
    TWICE(4);
#define LATE 5
    pause(LATE);
  }
}
