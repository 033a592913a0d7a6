// ports ?
#include "simpletools.h"
int main(void) {
  unsigned mask = 1 << getDec();
  OUTA |= mask;
  unsigned light = 1;
  while (1) { OUTA ^= light; light <<= 1; }
}
