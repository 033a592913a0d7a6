// ports 1 2
#include "propeller.h"
int main(void) {
  DIRA = 6;
  while (1) { OUTA ^= DIRA; waitcnt(CNT + CLKFREQ); }
}
