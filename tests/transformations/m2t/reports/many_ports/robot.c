#include "simpletools.h"

int main() {
  for (int pin = 0; pin < 27; pin++) {
    high(pin);
    pause(100);
    low(pin);
  }
}
