#include "simpletools.h"

int main() {
  while (1) {
    if (input(5)) high(6);
    else low(6);
    pause(20);
  }
}
