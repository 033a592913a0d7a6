#include "simpletools.h"

int main() {
  int x = ;
  while (1) {
    high(3);
  }
}
