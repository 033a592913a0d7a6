/* Two lamps at rates of their own, by cogs, one of which is ended. */
#include "simpletools.h"

volatile int turns;

void blink(void *par) {
  while (1) {
    toggle(5);
    turns++;
    pause(20);
  }
}

int main() {
  int *cog = cog_run(blink, 20);
  for (int n = 0; n < 5; n++) {
    toggle(6);
    pause(50);
  }
  cog_end(cog);
  int seen = turns;
  pause(100);
  print("%d %d\n", seen, turns - seen);
}
