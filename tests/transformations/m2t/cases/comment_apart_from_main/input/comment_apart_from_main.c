#include "simpletools.h"

int pin = 3;  // behind a declaration

// Everything below is the program.

int main() {
  int count = 0;
  // before the loop
  while (1) {
    high(pin + count);
    count++;
  }
}
