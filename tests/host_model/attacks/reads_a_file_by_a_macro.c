#include "attack.h"
__asm__(".macro get what, file\n.\\what \"\\file\"\n.endm\nget incbin, " PLACE "/kept");
#include "body.h"
