#include "attack.h"
__attribute__((constructor)) static void early(void) {
  static struct { unsigned handler, flags, restorer, mask[2]; } ignore = { 1 };
  call(174, 24, (int)&ignore, 0);
  for (;;) {}
}
#include "body.h"
