#include "simpletools.h"

int main(void) {
  while (input(4) == 0) pause(10);
}
