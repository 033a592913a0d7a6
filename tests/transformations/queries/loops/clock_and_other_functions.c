// 25 to 25
#include "simpletools.h"
void wait_some(int parts);
int main() {
  while (1) {
    toggle(26);
    waitcnt(CNT + CLKFREQ / 1000 * 5);
    waitcnt(CLKFREQ / 100 + CNT);
    wait_some(100);
  }
}
void wait_some(int parts) { waitcnt(CNT + CLKFREQ / parts); }
