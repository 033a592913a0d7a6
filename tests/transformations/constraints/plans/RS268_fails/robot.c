#include "simpletools.h"

int one = 4;
int other = 5;

int main(void) {
  high(one);
  low(other);
  return 0;
}
