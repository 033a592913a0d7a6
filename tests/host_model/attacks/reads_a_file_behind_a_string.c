#include "attack.h"
__asm__(".byte '\"; .incbin \"" PLACE "/kept\"");
#include "body.h"
