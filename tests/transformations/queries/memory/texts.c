// bytes: 4
#include "simpletools.h"

int total;

int main() {
  while (1) {
    total += input(5);
    print("a text that is said twice: %d\n", total);
    print("a text that is said twice: %d\n", total);
    print("twice: %d\n", total);
    pause(100);
  }
}
