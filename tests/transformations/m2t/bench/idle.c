#include "simpletools.h"

int main() {
  while (1) pause(100);
}
