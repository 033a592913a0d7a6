#include "simpletools.h"

int main(void) {
  while (1) {
    high(9);
    pause(1);
    print("%d\n", rc_time(9, 1));
    pause(200);
  }
}
