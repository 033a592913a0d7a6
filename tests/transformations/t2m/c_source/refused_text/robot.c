#include "simpletools.h"
#include "parts.h"

static int speed = 70000;

int main() {
  us = 90;
  _clkfreq = 40000000; // told
  speed = us;
  while (1) {
    high(3);
    ms += 4;
    _clkfreq++; // told
    print("%d\n", speed + part());
  }
}
