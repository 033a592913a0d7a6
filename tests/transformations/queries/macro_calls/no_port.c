#include "simpletools.h"
#define P(x) high(x)

int main() {
  P(sizeof(int));
  P(1.5);
  P(1 / 0);
  P(-5);
  high(-6);
  while (1);
}
