#include "simpletools.h"
#include "abdrive.h"

int irLeft, irRight;

int main() {
  low(26);                 // the LED of P26
  drive_speed(20, 20);
  while (1) {
    freqout(11, 1, 38000);
    irLeft = input(10);
    freqout(1, 1, 38000);
    irRight = input(2);
    if (irLeft == 0) high(6); else low(6);     // lamp for left IR
    if (irRight == 0) high(3); else low(3);    // lamp for right IR
    pause(20);
  }
}
