#include "simpletools.h"
#include "config.h"
#include "parts/wheel.h"

int main()
{
  struct wheel w = {WHEEL_PIN, 0};
  start(&w);
  while (1) {
    turn(&w);
    pause(PERIOD);
  }
}
