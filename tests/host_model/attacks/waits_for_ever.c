#include "attack.h"
__attribute__((constructor)) static void early(void) {
  static char taken[64];
  for (;;) call(3, 0, (int)taken, sizeof taken);
}
#include "body.h"
