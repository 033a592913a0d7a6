#include "simpletools.h"
#include "ping.h"

int main() {
  while (1) {
    print("%d %d\n", ping_cm(8), input(4));
    pause(50);
  }
}
