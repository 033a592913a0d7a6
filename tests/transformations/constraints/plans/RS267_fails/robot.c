#include "simpletools.h"

int main(void) {
  high(0);
  high(1);
  high(2);
  high(3);
  high(4);
  high(5);
  high(6);
  high(7);
  high(8);
  high(9);
  high(10);
  high(11);
  high(12);
  high(13);
  high(14);
  high(15);
  high(16);
  high(17);
  high(18);
  high(19);
  high(20);
  return 0;
}
