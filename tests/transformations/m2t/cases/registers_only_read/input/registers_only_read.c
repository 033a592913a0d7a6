#include "times.h"

unsigned started;

int main() {
  waitcnt(CNT += CLKFREQ / 1000);
  started = CNT = 5;
  CNT++;
  ++CNT;
  INA = 0;
  if ((INA |= 4) & 4) started = ++CNT;
  WAIT(CLKFREQ, 2);
  while (1) {
    int CNT_LEFT = 3;
    CNT_LEFT += 2;
    pause(CNT_LEFT);
  }
}
