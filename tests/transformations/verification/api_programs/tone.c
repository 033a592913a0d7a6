#include "simpletools.h"

int main() {
  while (1) {
    freqout(4, 500, 1000);
    pause(300);
    freqout(4, 250, 2000);
    pause(300);
  }
}
