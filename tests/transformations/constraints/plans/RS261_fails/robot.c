#include "simpletools.h"

int line = 10;

int main(void) {
  high(line);
  pause(1);
  return input(line);
}
