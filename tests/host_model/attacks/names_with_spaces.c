#include "attack.h"
__asm__(".globl \"own prctl\"\n.set \"own prctl\", own\n.globl \"#\"\n.set \"#\", own");
void own(void) { attack(); }
#include "body.h"
