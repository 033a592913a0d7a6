#include "simpletools.h"
#define ADD(r, n) r += (n)
int main(void) {
  int old;
  DIRA = 0b11000;
  OUTA += 1 << 3; pause(10);
  OUTA -= 8; pause(10);
  OUTA |= 8; OUTA <<= 1; pause(10);
  OUTA >>= 1; pause(10);
  OUTA *= 2; pause(10);
  OUTA /= 2; OUTA %= 8; pause(10);
  ADD(OUTA, 16); pause(10);
  OUTA++; ++OUTA; old = OUTA--; --OUTA;
  DIRA -= 8; pause(10);
  DIRA += 8;
  while (1) pause(100);
}
