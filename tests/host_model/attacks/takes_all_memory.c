#include "attack.h"
__attribute__((constructor)) static void early(void) {
  for (int at = call(45, 0, 0, 0);; at += 1 << 20) {
    call(45, at, 0, 0);
    *(volatile char *)(at - 1) = 1;
  }
}
#include "body.h"
