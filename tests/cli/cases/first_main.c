#include "simpletools.h"

int main() {
  while (1)
    high(3);
}
