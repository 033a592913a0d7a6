// ports 22 23
#include "simpletools.h"
int left = 22, right = 23;
int main(void) {
  int side = getDec();
  int pin = side ? left : right;
  DIRA |= 1 << pin;
  OUTA |= (side > 2) << pin;
}
