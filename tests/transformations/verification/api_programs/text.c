#include "simpletools.h"

int main() {
  int count = 0;
  char digits[9];
  while (1) {
    count++;
    sprintf(digits, "%X", 44029 + count);
    print("count %d, %3.1f, %s\n", count, count / 2.0, digits);
    pause(250);
  }
}
