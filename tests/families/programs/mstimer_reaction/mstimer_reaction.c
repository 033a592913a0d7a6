/* How long somebody takes to press a button after a lamp goes on. */
#include "simpletools.h"
#include "mstimer.h"

int main() {
  mstime_start();
  pause(100);
  print("%d\n", mstime_get());
  high(4);
  mstime_reset();
  while (!input(3))
    ;
  int t = mstime_get();
  low(4);
  print("%d ms\n", t);
  mstime_set(-50);
  pause(30);
  print("%d\n", mstime_get());
  mstime_stop();
  pause(40);
  print("%d\n", mstime_get());
}
