#include "simpletools.h"

int main(void) {
  int n = 3;
  for (;;) { n = n + 1; pause(n); }
}
