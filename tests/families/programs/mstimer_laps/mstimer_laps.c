/* Lamps that blink at rates of their own by one timer, without a wait. */
#include "simpletools.h"
#include "mstimer.h"

int main() {
  int next[2] = {0, 0};
  const int every[2] = {70, 110};
  low(5);
  low(6);
  mstime_start();
  mstime_reset();
  while (mstime_get() < 1000)
    for (int n = 0; n < 2; n++)
      if (mstime_get() >= next[n]) {
        toggle(5 + n);
        next[n] += every[n];
      }
  print("%d %d\n", next[0], next[1]);
}
