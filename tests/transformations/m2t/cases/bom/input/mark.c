#include "simpletools.h"
// Größe
int main() {
  high(1);
  while (1) { low(1); }
}
