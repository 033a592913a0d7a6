#include "simpletools.h"

int line = 10;

int main(void) {
  return input(line);
}
