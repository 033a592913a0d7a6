#include "simpletools.h"

int sensor = 10;
int row = 1, column = 2;

int main(void) {
  high(row);
  if (input(column)) low(row);
  return input(sensor);
}
