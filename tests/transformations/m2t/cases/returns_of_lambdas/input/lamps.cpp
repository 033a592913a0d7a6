#include "simpletools.h"

int main() {
  auto on = [](int p) {
    if (p > 20) return;
    high(p);
  };
  auto pin = [](int i) -> int { return 8 + i; };
  struct Lamp {
    int p;
    int pin() { return p; }
  };
  Lamp lamp;
  lamp.p = 9;
  on(lamp.pin());
  if (pin(0) > 9) return 1;
  while (1) {
    auto blink = [](int p) -> int { toggle(p); return p; };
    if (blink(4) > 4) return 2;
    pause(100);
  }
}
