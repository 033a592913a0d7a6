/* Each press of a button is counted. */
#include "simpletools.h"

int main() {
  int presses = 0;
  while (1) {
    if (input(3)) {
      presses++;
      print("%d\n", presses);
      while (input(3)) pause(10);
    }
    pause(10);
  }
}
