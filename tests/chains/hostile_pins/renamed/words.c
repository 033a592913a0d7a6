#include "simpletools.h"

enum { private = 5, public };

int main(void) {
  high(private);
  while (1) pause(100);
}
