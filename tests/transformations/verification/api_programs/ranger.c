#include "simpletools.h"
#include "ping.h"

int main() {
  while (1) {
    int distance = ping_cm(9);
    print("%d cm\n", distance);
    if (distance < 50) high(6);
    else low(6);
    pause(200);
  }
}
