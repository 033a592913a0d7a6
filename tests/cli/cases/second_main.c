#include "simpletools.h"

int main() {
  while (1)
    low(3);
}
