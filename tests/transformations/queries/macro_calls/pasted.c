#include "simpletools.h"
#define CAT(a, b) a##b
#define PIN CAT(1, 2)
#define FIRST CAT(hi, gh)(13)
#define LOW(n) CAT(lo, w)(n)

int main() {
  high(PIN);
  CAT(hi, gh)(10);
  FIRST;
  LOW(14);
  low(15);
  while (1);
}
