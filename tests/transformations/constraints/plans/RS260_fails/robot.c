#include "simpletools.h"

int sensor = 10;

int main(void) {
  high(sensor);
  return 0;
}
