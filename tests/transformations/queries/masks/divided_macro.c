// ports 1 10 21
#include "simpletools.h"
#define ONE 0 + 1
#define LED 8 + 2
int main() {
  OUTA |= 1 << (20 - ONE);
  low(2 * ONE);
  high(LED);
}
