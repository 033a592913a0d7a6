#include "simpletools.h"

int main() {
  int count = 0;
  while (1) {
    count++;
    print("count %d, %3.1f\n", count, count / 2.0);
    pause(250);
  }
}
