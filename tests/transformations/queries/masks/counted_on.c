// ports ?
#include "simpletools.h"
int main(void) {
  int pin = 3;
  while (getDec()) { OUTA ^= 1 << pin; pin = pin + 1; }
}
