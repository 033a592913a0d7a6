#include "attack.h"
int own __attribute__((section("own,\"aw\"\n.incbin \"" PLACE "/kept\" #"))) = 1;
#include "body.h"
