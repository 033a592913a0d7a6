/* The counter as a clock, pins one by one, and locks. */
#include "simpletools.h"
#include "propeller.h"

int main() {
  unsigned begin = CNT;
  pause(25);
  print("%d ms\n", (CNT - begin) / (CLKFREQ / 1000));
  setpin(7, 1);
  waitcnt(CLKFREQ / 100 + CNT);
  togglepin(7);
  print("%d %d\n", getpin(3), INA >> 3 & 1);
  int a = locknew(), b = locknew();
  print("%d %d\n", a != b, lockset(a));
  print("%d %d ", lockset(a), lockset(b));
  lockclr(a);
  print("%d\n", lockset(a));
  lockret(a);
  lockret(b);
  DIRA |= 1 << 9;
  print("%x\n", DIRA & 0x280);
  waitcnt2(CNT + 800000, 0);
}
