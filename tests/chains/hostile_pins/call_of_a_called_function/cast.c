#include "simpletools.h"
typedef void (*op)(int);
int main(void) {
  ((op)high)(3);
  pause(400);
  (*(void (*)(int))low)(3);
  high(4); pause(100); low(4);
  while (1) pause(100);
}
