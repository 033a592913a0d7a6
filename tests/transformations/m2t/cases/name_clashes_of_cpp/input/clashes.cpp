#include "simpletools.h"

constexpr int port(int n) { return 8 + n; }

struct Lamp {
  int pin;
  void delay(int ms) const { high(pin); pause(ms); low(pin); }
};

int word = 3;
static Lamp lamp = {9};

int main() {
  while (1) {
    high(port(0));
    lamp.delay(100 * word);
    low(port(0));
    pause(100);
  }
}
