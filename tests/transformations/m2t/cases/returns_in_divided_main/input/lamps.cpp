#include "simpletools.h"

int main() {
  int lamp = 9;
  auto on = [](int p) {
    if (p > 20) return;
    high(p);
  };
  on(lamp);
  while (1) {
    auto off = [](int p) {
      if (p > 20) return;
      low(p);
    };
    off(8);
    if (lamp > 9) continue;
    pause(100);
  }
}
