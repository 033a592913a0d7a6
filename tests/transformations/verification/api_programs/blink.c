#include "simpletools.h"

int main() {
  while (1) {
    high(26);
    pause(200);
    low(26);
    pause(300);
  }
}
