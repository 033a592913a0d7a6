#include "simpletools.h"

int sensor = 10;

int main(void) {
  return input(sensor);
}
