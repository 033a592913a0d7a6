#include "wheel.h"
#ifdef FAST
const int STEP = 2;
#else
const int STEP = 1;
#endif
int main() {
  Wheel wheel(3);
  while (true) { wheel.turn(STEP); tick(); }
}
