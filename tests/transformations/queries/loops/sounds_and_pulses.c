// 61 to 61
#include "simpletools.h"
int main() {
  while (1) {
    toggle(26);
    freqout(4, 40, 2000);
    for (int i = 0; i < 2; i++) pulse_out(5, 500);
    waitcnt(CNT + 1600000);
  }
}
