#include "simpletools.h"
#define MAX(x, y) ((x) > (y) ? (x) : (y))

int main() {
  int pin = MAX(18, 17);
  high(pin);
}
