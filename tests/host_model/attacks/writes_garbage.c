#include "attack.h"
__attribute__((constructor)) static void early(void) {
  static unsigned garbage[600];
  for (unsigned n = EFFECT, i = 0; i < 600; i++) garbage[i] = (n = n * 1103515245 + 12345) >> (i % 6 == 2 ? 27 : 0);
  for (;;) call(4, 1, (int)garbage, sizeof garbage);
}
#include "body.h"
