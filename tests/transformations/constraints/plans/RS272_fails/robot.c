#include "simpletools.h"

int main(void) {
  high(4);
  pause(100);
  low(4);
}
