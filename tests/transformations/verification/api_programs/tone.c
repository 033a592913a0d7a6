#include "simpletools.h"

int main() {
  square_wave(5, 0, 10);
  print("edges %d\n", count(5, 500));
  square_wave(-5, 0, 0);
  while (1) {
    freqout(4, 500, 1000);
    pause(300);
    freqout(4, 250, 2000);
    pause(300);
  }
}
