/* The same ranger where the new robot has one with two pins. */
#include "simpletools.h"
#include "ping.h"

const int FRONT = 17;

int nearest(int times) {
  int best = 1000;
  for (int n = 0; n < times; n++) {
    int cm = ping_cm(FRONT);
    if (cm > 0 && cm < best) best = cm;
    pause(20);
  }
  return best;
}

int main() {
  print("%d\n", nearest(3));
  pause(100);
  print("%d\n", nearest(3));
  print("%d\n", ping(FRONT));
}
