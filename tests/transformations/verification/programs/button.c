/* A button lights a lamp and sounds a speaker, a voltage is printed, and each press is counted. */
#include "simpletools.h"

int main() {
  int presses = 0;
  low(26);
  while (1) {
    if (input(3) == 1) {
      presses++;
      print("presses %d\n", presses);
      high(26);
      pause(300);
      low(26);
      freqout(4, 200, 3000);
      while (input(3) == 1)
        pause(5);
    }
    pause(10);
  }
}
