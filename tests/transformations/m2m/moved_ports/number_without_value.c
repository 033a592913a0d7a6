// expect D8=1 D7=1 D6=1
// What C gives no value drives nothing, whatever the compiler takes it for.
#include "simpletools.h"

#define PIN(n) (n)

int main(void)
{
  for (int i = 1; i <= 3; i++) {
    high(i);
    print("%d", i);
  }
  high(PIN(1 / 0));
}
