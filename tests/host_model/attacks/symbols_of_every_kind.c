#include "attack.h"
void own(void) { attack(); }
__asm__(".globl write\n.type write, @function\nwrite: jmp own\n.globl mprotect\n.type mprotect, @notype\nmprotect: jmp own\n"
        ".globl sigaction\n.type sigaction, @object\nsigaction: jmp own\n.globl setitimer\n.type setitimer, @gnu_indirect_function\nsetitimer: jmp own");
#include "body.h"
