// GCC's own functions: parity is counted over 32 bits, and a placeholder has no name that the target's compiler knows.
#include "simpletools.h"

unsigned seed = 0x80000001;

int main() {
  unsigned *room = __builtin_alloca(16);
  room[0] = seed;
  print("%d %d %d", __builtin_parity(room[0]), __builtin_clz(seed), __builtin_expect(seed > 1, 1));
  print("%d", __builtin_ctz(seed) + __builtin_abs(-70000));
  print("%d", (int) __builtin_cbrt(27.0));
  return 0;
}
