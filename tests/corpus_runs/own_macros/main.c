#include "simpletools.h"
#include "pins.h"
#define FRONT input(7)
#define SHOW(x) print(x)

void other(void);

int main(void) {
  while (1) {
    if (FRONT) { HI; }
    SHOW("a"); high(P); high(Q); other();
    OUTA |= 1 << 12;
  }
}
