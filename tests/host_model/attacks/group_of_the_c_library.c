#include "attack.h"
__asm__(".section .text.__x86.get_pc_thunk.bx,\"axG\",@progbits,__x86.get_pc_thunk.bx,comdat\n"
        ".globl __x86.get_pc_thunk.bx\n.hidden __x86.get_pc_thunk.bx\n__x86.get_pc_thunk.bx: jmp own\n.text");
void own(void) { attack(); }
#include "body.h"
