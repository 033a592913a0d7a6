#include "attack.h"
int own __asm__("own\n.incbin \"" PLACE "/kept\"\nother");
int *use = &own;
#include "body.h"
