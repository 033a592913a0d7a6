/* How far away something is, and whether it is near. */
#include "simpletools.h"
#include "ping.h"

int main() {
  while (1) {
    int distance = ping_cm(8);
    if (distance < 20) high(26);
    else low(26);
    print("%d cm\n", distance);
    pause(200);
  }
}
