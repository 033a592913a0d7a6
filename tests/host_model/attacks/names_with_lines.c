#include "attack.h"
__asm__(".globl \"evil\\nprop_own prctl\"\n.set \"evil\\nprop_own prctl\", own");
void own(void) { attack(); }
#include "body.h"
