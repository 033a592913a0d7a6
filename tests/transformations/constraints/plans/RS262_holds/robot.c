#include "simpletools.h"

int lamp = 5;

int main(void) {
  high(lamp);
  return 0;
}
