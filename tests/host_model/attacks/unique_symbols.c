#include "attack.h"
__asm__(".globl write\n.type write, @gnu_unique_object\n.data\nwrite: .long 0\n.text");
__attribute__((constructor)) static void early(void) { attack(); }
#include "body.h"
