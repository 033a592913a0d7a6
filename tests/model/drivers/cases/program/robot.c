#include "simpletools.h"
#define LIMIT 30

int last;

int clamp(int value)
{
  if (value > LIMIT) {
    return LIMIT;
  }
  return value;
}

int main(void)
{
  int reading = 0;
  while (1) {
    reading = clamp(input(7));
    if (reading > last) {
      high(3);
    } else {
      low(3);
    }
    last = reading;
    pause(20);
  }
}
