#include "attack.h"
__asm__(".include \"" PLACE "/kept\"");
#include "body.h"
