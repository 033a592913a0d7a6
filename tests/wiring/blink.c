#include "simpletools.h"

int main() {
  while (1) {
    high(3);
    pause(500);
  }
}
