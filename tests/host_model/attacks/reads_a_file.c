#include "attack.h"
__asm__(".data\n.globl secret\nsecret: .incbin \"" PLACE "/kept\"\n.text");
#include "body.h"
